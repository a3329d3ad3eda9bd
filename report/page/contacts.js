// Finds the contacts of a packing: the same rule as the metrics coordination and stable_alone.

// Unit normals into each sphere, {partner, normal[3]} of its contacts; partner −1 is a wall. Each sphere looks for
// partners no larger than itself among the cells that it could reach, so the work grows with the number of cells,
// whatever the spread of the radii.
function findContacts(packing) {
  const {dimension, size, boundary, centres, radii, gap} = packing;
  const n = radii.length;
  const contacts = Array.from({length: n}, () => []);
  const grid = cellGrid(packing);
  for (let i = 0; i < n; ++i) {
    grid.forEachNear(i, 2 * radii[i] * (1 + gap), j => {
      if (j === i || radii[j] > radii[i] || (radii[j] === radii[i] && j > i)) return;
      const reach = radii[i] + radii[j] * (1 + gap);
      let nearest2 = 0;
      for (let a = 0; a < dimension; ++a) {
        let d = centres[3 * i + a] - centres[3 * j + a];
        if (boundary[a] === 'periodic') d -= size[a] * Math.round(d / size[a]);
        nearest2 += d * d;
      }
      if (nearest2 > reach * reach * 1.000001) return; // most pairs; the margin is for rounding
      for (const d of separations(packing, i, j, reach)) {
        const distance = Math.hypot(...d);
        if (distance - radii[i] - radii[j] > gap * radii[j]) continue;
        const normal = d.map(x => distance > 0 ? x / distance : 0);
        contacts[i].push({partner: j, normal});
        contacts[j].push({partner: i, normal: normal.map(x => -x)});
      }
    });
    for (let a = 0; a < dimension; ++a) {
      const floor = boundary[a] === 'wall' || (boundary[a] === 'open' && a === dimension - 1);
      const at = centres[3 * i + a];
      if (floor && at - radii[i] <= gap * radii[i]) contacts[i].push(wall(a, 1));
      if (boundary[a] === 'wall' && size[a] - at - radii[i] <= gap * radii[i]) contacts[i].push(wall(a, -1));
    }
  }
  return contacts;
}

// From the images of j that could touch i, to i. Large spheres of a small periodic box may touch on both sides.
function separations({dimension, size, boundary, centres}, i, j, reach) {
  let found = [[0, 0, 0]];
  for (let a = 0; a < dimension; ++a) {
    const d = centres[3 * i + a] - centres[3 * j + a];
    const along = boundary[a] === 'periodic' ? [-1, 0, 1].map(k => d + k * size[a]) : [d];
    const near = along.filter(x => Math.abs(x) <= reach);
    found = near.flatMap(x => found.map(old => old.map((y, b) => b === a ? x : y)));
  }
  return found;
}

function wall(axis, sign) {
  const normal = [0, 0, 0];
  normal[axis] = sign;
  return {partner: -1, normal};
}

// The centres in cells as wide as the mean distance of spheres.
function cellGrid({dimension, size, boundary, centres, radii}) {
  const n = radii.length;
  const axes = [0, 1, 2].map(a => {
    let low = 0, high = size[a];
    for (let i = 0; i < n; ++i) {
      low = Math.min(low, centres[3 * i + a]);
      high = Math.max(high, centres[3 * i + a]);
    }
    return boundary[a] === 'periodic' ? {low: 0, length: size[a]} : {low, length: high - low};
  });
  let volume = 1;
  for (let a = 0; a < dimension; ++a) volume *= axes[a].length || 1;
  const width = (volume / Math.max(1, n)) ** (1 / dimension);
  const cells = axes.map((axis, a) => a < dimension ? Math.max(1, Math.floor(axis.length / width)) : 1);
  const cellOf = (x, a) => cells[a] === 1 ? 0 : Math.floor((x - axes[a].low) / axes[a].length * cells[a]);
  const clamp = (c, a) => Math.min(cells[a] - 1, Math.max(0, c));
  const index = c => (c[2] * cells[1] + c[1]) * cells[0] + c[0];
  const lists = Array.from({length: cells[0] * cells[1] * cells[2]}, () => []);
  for (let i = 0; i < n; ++i) lists[index([0, 1, 2].map(a => clamp(cellOf(centres[3 * i + a], a), a)))].push(i);

  // The cells of one axis that a ball of this radius reaches; over a periodic face they go on at the other side.
  const reached = (x, radius, a) => {
    let first = cellOf(x - radius, a), last = cellOf(x + radius, a);
    if (boundary[a] !== 'periodic') { first = clamp(first, a); last = clamp(last, a); }
    else if (last - first >= cells[a]) { first = 0; last = cells[a] - 1; }
    return Array.from({length: last - first + 1}, (_, k) => ((first + k) % cells[a] + cells[a]) % cells[a]);
  };
  return {forEachNear(i, radius, f) {
    const [xs, ys, zs] = [0, 1, 2].map(a => reached(centres[3 * i + a], radius, a));
    for (const z of zs) for (const y of ys) for (const x of xs) for (const j of lists[index([x, y, z])]) f(j);
  }};
}
