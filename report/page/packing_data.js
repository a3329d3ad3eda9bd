// Reads a packing out of the page: centres and radii with all their digits, only once it is asked for.

// Returns {key, title, dimension, unit, size[3], boundary[3], gap, count, shown, height, whole, centres (3 numbers a
// sphere, from the box's lower corner; 0 for the third of a disc), radii}.
function readPacking(block) {
  const data = block.dataset;
  const dimension = Number(data.dimension);
  const bytes = Uint8Array.from(atob(block.textContent), character => character.charCodeAt(0));
  const numbers = new Float64Array(bytes.buffer); // little-endian, as every browser's machine is
  const n = Number(data.shown);
  const centres = new Float64Array(3 * n);
  for (let i = 0; i < n; ++i)
    for (let axis = 0; axis < dimension; ++axis) centres[3 * i + axis] = numbers[dimension * i + axis];
  const size = data.size.split(' ').map(Number);
  const boundary = data.boundary.split(' ');
  if (dimension === 2) { size.push(0); boundary.push('open'); }
  const count = Number(data.count);
  return {key: data.key, title: data.title, dimension, unit: data.unit, size, boundary, gap: Number(data.gap), count,
    shown: n, height: Number(data.height), whole: n === count, centres, radii: numbers.slice(dimension * n)};
}

// Whether a sphere is cut by the faces of the part that is shown, so that its contacts beyond are not known.
function isCut(packing, i) {
  if (packing.whole) return false;
  const vertical = packing.dimension - 1;
  const z = packing.centres[3 * i + vertical], r = packing.radii[i];
  return z + r > packing.height || (packing.boundary[vertical] === 'periodic' && z - r < 0);
}
