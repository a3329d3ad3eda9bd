// The picture of a packing: its spheres in one draw call and the edges of its box, drawn only when asked.

// Centres and radii with the images that reach into the box over its periodic faces; `of` names the sphere of each.
function withImages(packing) {
  const {size, boundary, centres, radii} = packing;
  const centre = [], radius = [], of = [];
  const add = (place, i, axis) => {
    if (axis === 3) { centre.push(...place.map((x, a) => x - size[a] / 2)); radius.push(radii[i]); of.push(i); return; }
    add(place, i, axis + 1);
    if (boundary[axis] !== 'periodic') return;
    for (const side of [-1, 1]) {
      const image = place.slice();
      image[axis] += side * size[axis];
      if (image[axis] + radii[i] > 0 && image[axis] - radii[i] < size[axis]) add(image, i, axis + 1);
    }
  };
  for (let i = 0; i < radii.length; ++i) add([...centres.subarray(3 * i, 3 * i + 3)], i, 0);
  return {centre: new Float32Array(centre), radius: new Float32Array(radius), of};
}

// The six faces of the box as frames, each with the direction it looks to.
function boxFaces(size) {
  const material = new THREE.LineBasicMaterial({color: 0x808890, depthTest: false, transparent: true});
  const faces = [];
  for (const axis of [0, 1, 2]) for (const side of [-1, 1]) {
    const [u, v] = [(axis + 1) % 3, (axis + 2) % 3];
    const corners = [[-1, -1], [1, -1], [1, 1], [-1, 1]].map(([x, y]) => {
      const corner = [0, 0, 0];
      corner[axis] = side * size[axis] / 2;
      corner[u] = x * size[u] / 2;
      corner[v] = y * size[v] / 2;
      return new THREE.Vector3(...corner);
    });
    const face = new THREE.LineLoop(new THREE.BufferGeometry().setFromPoints(corners), material);
    face.outward = new THREE.Vector3().setComponent(axis, side);
    faces.push(face);
  }
  return faces;
}

class PackingView {
  // Throws an Error where the browser has no WebGL 2.
  constructor(canvas) {
    const context = canvas.getContext('webgl2', {alpha: true, antialias: false, preserveDrawingBuffer: true});
    if (!context) throw new Error('This browser offers no WebGL 2, which the picture needs.');
    this.canvas = canvas;
    this.renderer = new THREE.WebGLRenderer({canvas, context, alpha: true, preserveDrawingBuffer: true});
    this.renderer.setClearColor(0, 0);
    this.camera = new THREE.OrthographicCamera(-1, 1, 1, -1, 0.1, 10);
    this.uniforms = {right: {value: new THREE.Vector3()}, upward: {value: new THREE.Vector3()},
      toward: {value: new THREE.Vector3()}, low: {value: new THREE.Vector3()}, high: {value: new THREE.Vector3()},
      stops: {value: viridis.map(stop => new THREE.Vector3(...stop))}, pixel: {value: 1}};
    this.material = new THREE.RawShaderMaterial({uniforms: this.uniforms, vertexShader: sphereVertexShader,
      fragmentShader: sphereFragmentShader, transparent: true}); // three.js draws all transparent things by renderOrder
    this.cuts = [1, 1, 1];
    new ResizeObserver(() => this.ask()).observe(canvas);
  }

  show(packing) {
    this.packing = packing;
    const {centre, radius, of} = withImages(packing);
    Object.assign(this, {centre, of, sorted: null});
    // Four corners a sphere in one plain mesh: instances of so few corners are slow, in software above all.
    const corners = new Uint32Array(4 * of.length).map((_, c) => c >> 2);
    const geometry = new THREE.BufferGeometry();
    geometry.setAttribute('position', new THREE.BufferAttribute(
      new Float32Array(3 * corners.length).map((_, c) => centre[3 * corners[Math.floor(c / 3)] + c % 3]), 3));
    geometry.setAttribute('radius', new THREE.BufferAttribute(Float32Array.from(corners, k => radius[k]), 1));
    geometry.setAttribute('tone', new THREE.BufferAttribute(new Float32Array(corners.length), 1));
    geometry.setIndex(new THREE.BufferAttribute(new Uint32Array(6 * of.length), 1));
    if (this.spheres) this.spheres.geometry.dispose();
    this.spheres = new THREE.Mesh(geometry, this.material);
    this.spheres.frustumCulled = false; // all corners of a square lie in its centre until the shader moves them
    this.scene = new THREE.Scene();
    this.faces = boxFaces(packing.size);
    this.scene.add(this.spheres, ...this.faces);
    // Spheres may stand above an open box.
    this.top = packing.size.slice();
    for (let k = 0; k < radius.length; ++k)
      for (let a = 0; a < packing.dimension; ++a)
        if (packing.boundary[a] !== 'periodic')
          this.top[a] = Math.max(this.top[a], centre[3 * k + a] + packing.size[a] / 2 + radius[k]);
    this.home();
  }

  colour(values) {
    const tone = this.spheres.geometry.getAttribute('tone');
    this.of.forEach((i, k) => tone.array.fill(values[i], 4 * k, 4 * k + 4));
    tone.needsUpdate = true;
    this.ask();
  }

  // Where a new packing is looked at from: a disc's from above, a box's from one of its upper corners.
  home() {
    this.yaw = this.packing.dimension === 2 ? 0 : Math.PI - 0.5; // the faces that cuts lay open look here
    this.pitch = this.packing.dimension === 2 ? Math.PI / 2 : 0.45; // above the horizon
    this.zoom = 1;
    this.shift = [0, 0];
    this.ask();
  }

  // Brings the spheres into an order from the front to the back, roughly: what is hidden need not be drawn. The depth
  // test decides within a layer.
  sort(toward) {
    const centre = this.centre;
    const n = this.of.length, layers = 4096;
    const reach = Math.hypot(...this.top);
    const layer = new Uint16Array(n), start = new Uint32Array(layers + 1);
    for (let k = 0; k < n; ++k) {
      const depth = centre[3 * k] * toward.x + centre[3 * k + 1] * toward.y + centre[3 * k + 2] * toward.z;
      layer[k] = Math.min(layers - 1, Math.max(0, Math.floor(0.5 * (1 - depth / reach) * layers)));
      ++start[layer[k] + 1];
    }
    for (let l = 0; l < layers; ++l) start[l + 1] += start[l];
    const index = this.spheres.geometry.index;
    for (let k = 0; k < n; ++k) {
      const c = 4 * k;
      index.array.set([c, c + 1, c + 2, c, c + 2, c + 3], 6 * start[layer[k]]++);
    }
    index.needsUpdate = true;
    this.sorted = toward.clone();
  }

  ask() {
    if (!this.asked && this.packing) this.asked = requestAnimationFrame(() => this.draw());
  }

  draw() {
    this.asked = 0;
    const {size, boundary, dimension} = this.packing;
    const width = this.canvas.clientWidth, height = this.canvas.clientHeight;
    if (!width || !height) return;
    this.renderer.setPixelRatio(Math.min(2, window.devicePixelRatio));
    this.renderer.setSize(width, height, false);

    const flat = dimension === 2;
    const reach = Math.hypot(...size);
    const span = (flat ? 1.04 * Math.max(size[1], size[0] * height / width) : 1.02 * Math.max(reach, reach * height / width))
      / this.zoom;
    const [cy, sy, cp, sp] = [Math.cos(this.yaw), Math.sin(this.yaw), Math.cos(this.pitch), Math.sin(this.pitch)];
    const {right, upward, toward, low, high, pixel} = this.uniforms;
    right.value.set(cy, sy, 0);
    toward.value.set(sy * cp, -cy * cp, sp);
    upward.value.crossVectors(toward.value, right.value);
    pixel.value = span / height;
    const camera = this.camera;
    camera.top = span / 2; camera.bottom = -span / 2;
    camera.right = span / 2 * width / height; camera.left = -camera.right;
    camera.near = 0; camera.far = 4 * reach;
    const target = right.value.clone().multiplyScalar(-this.shift[0]).addScaledVector(upward.value, -this.shift[1]);
    camera.up.copy(upward.value);
    camera.position.copy(target).addScaledVector(toward.value, 2 * reach);
    camera.lookAt(target);
    camera.updateProjectionMatrix();

    const far = 4 * Math.max(...this.top);
    const keep = [0, 1, 2].map(a => {
      if (flat && a === 2) return 0; // a disc is the cut through a sphere's middle
      const uncut = boundary[a] === 'periodic' ? size[a] / 2 : far;
      let at = this.cuts[a] >= 1 ? uncut : this.cuts[a] * this.top[a] - size[a] / 2;
      if (!this.packing.whole && a === dimension - 1) at = Math.min(at, this.packing.height - size[a] / 2);
      return at;
    });
    high.value.set(...keep);
    low.value.set(...[0, 1, 2].map(a => boundary[a] === 'periodic' ? -size[a] / 2 : -far));
    if (!this.sorted || !this.sorted.equals(toward.value)) this.sort(toward.value);
    // The box holds all spheres, so what lies on its front faces is drawn over them, the rest under them.
    for (const face of this.faces) face.renderOrder = face.outward.dot(toward.value) > 1e-6 ? 1 : -1;
    this.renderer.render(this.scene, camera);
  }
}
