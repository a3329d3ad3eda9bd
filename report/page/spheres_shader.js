// Draws exact spheres, cut by planes along the axes: a square for each, in which every pixel casts its ray.

// Parallel projection: all rays have the direction `toward` (the viewer), so a ray meets a sphere between t0 and t1,
// the clipping box between two other numbers, and what is seen lies at the largest t that is in both.
// Depth is that of the centre, the same in the whole square. For spheres that do not overlap this is exact: of two, the
// one whose centre is nearer lies in front wherever both are met, as a plane across the line of centres parts them.
// So no pixel needs a depth of its own, and those behind others are rejected before their ray is cast.
const sphereVertexShader = `#version 300 es
precision highp float;
in vec3 position; // of the centre, the same for the square's four corners
in float radius;
in float tone;
uniform mat4 modelViewMatrix, projectionMatrix;
uniform vec3 right, upward;
out vec3 start;
flat out vec4 sphere;
flat out float shownTone;
void main() {
  int corner = gl_VertexID & 3;
  start = position + radius * ((corner == 1 || corner == 2 ? 1.0 : -1.0) * right + (corner > 1 ? 1.0 : -1.0) * upward);
  sphere = vec4(position, radius);
  shownTone = tone;
  gl_Position = projectionMatrix * modelViewMatrix * vec4(start, 1.0);
}`;

const sphereFragmentShader = `#version 300 es
precision highp float;
in vec3 start;
flat in vec4 sphere;
flat in float shownTone;
uniform vec3 right, upward, toward, low, high, stops[5];
uniform float pixel; // its width in the packing's unit
out vec4 colour;

vec3 colourOf(float tone) {
  if (tone < 0.0) return vec3(0.6);
  float at = 4.0 * tone;
  int i = int(min(at, 3.0));
  return mix(stops[i], stops[i + 1], at - float(i));
}

void main() {
  vec3 offset = start - sphere.xyz;
  float half2 = sphere.w * sphere.w - dot(offset, offset);
  if (half2 < 0.0) discard;
  float t1 = sqrt(half2), t0 = -t1;
  vec3 normal = (offset + t1 * toward) / sphere.w;
  float rim = 0.0; // distance from the edge of a cap
  bool cap = false;
  for (int a = 0; a < 3; ++a) {
    if (abs(toward[a]) < 1e-6) { // the ray runs along this face
      if (start[a] < low[a] || start[a] > high[a]) discard;
      continue;
    }
    float first = (low[a] - start[a]) / toward[a], last = (high[a] - start[a]) / toward[a];
    t0 = max(t0, min(first, last));
    float leaves = max(first, last);
    if (leaves < t1) {
      t1 = leaves;
      normal = vec3(0.0);
      normal[a] = sign(toward[a]);
      cap = true;
    }
  }
  if (t0 > t1) discard;
  vec3 point = start + t1 * toward;
  float light = 0.45 + 0.55 * max(0.0, dot(normal, normalize(toward - 0.4 * right + 0.6 * upward)));
  if (cap) light = (0.72 + 0.24 * light) * mix(0.55, 1.0, smoothstep(0.0, 1.5 * pixel, sphere.w - length(point - sphere.xyz)));
  colour = vec4(light * colourOf(shownTone), 1.0);
}`;
