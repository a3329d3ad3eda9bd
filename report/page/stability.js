// Whether a sphere, looked at alone, rests: its weight must be a sum of pushes along its contact normals.

// Length of what no push can carry of a unit weight: 0 at rest, 1 in free fall. Non-negative least squares by active
// sets (Lawson and Hanson, Solving Least Squares Problems, 1974, chapter 23), as the metric stable_alone does.
function freeDescent(normals, dimension) {
  const up = [0, 0, 0];
  up[dimension - 1] = 1;
  let pressing = []; // {normal, lambda}, at most `dimension`
  let left = up;
  const opposes = 1e-14; // cosine of rounding
  for (let pass = 0; pass < 1000 && pressing.length < dimension; ++pass) {
    let strongest = null;
    for (const normal of normals) if (!strongest || dot(normal, left) > dot(strongest, left)) strongest = normal;
    if (!strongest || dot(strongest, left) <= opposes) break;
    pressing.push({normal: strongest, lambda: 0});
    pressing = settled(pressing, up);
    left = up.map((x, a) => x - pressing.reduce((sum, p) => sum + p.lambda * p.normal[a], 0));
  }
  return Math.hypot(...left);
}

const dot = (a, b) => a[0] * b[0] + a[1] * b[1] + a[2] * b[2];

// Least squares over the pressing contacts; those that would pull are left out one after the other.
function settled(pressing, up) {
  while (pressing.length > 0) {
    const wanted = leastSquares(pressing.map(p => p.normal), up);
    let step = 1, first = -1;
    pressing.forEach((p, i) => {
      const share = p.lambda / (p.lambda - wanted[i]);
      if (wanted[i] <= 0 && share < step) { step = share; first = i; }
    });
    pressing.forEach((p, i) => { p.lambda += step * (wanted[i] - p.lambda); });
    if (first < 0) break;
    pressing.splice(first, 1);
  }
  return pressing;
}

// Coefficients of the columns that come closest to b: orthogonal columns (modified Gram–Schmidt), then back.
function leastSquares(columns, b) {
  const q = [], r = columns.map(() => []);
  columns.forEach((column, j) => {
    let rest = column;
    q.forEach((unit, i) => {
      r[i][j] = dot(unit, rest);
      rest = rest.map((x, a) => x - r[i][j] * unit[a]);
    });
    r[j][j] = Math.hypot(...rest);
    q.push(rest.map(x => r[j][j] > 0 ? x / r[j][j] : 0));
  });
  const x = [];
  for (let j = columns.length - 1; j >= 0; --j) {
    let sum = dot(q[j], b);
    for (let k = j + 1; k < columns.length; ++k) sum -= r[j][k] * x[k];
    x[j] = r[j][j] > 0 ? sum / r[j][j] : 0;
  }
  return x;
}
