// 3 × 3 matrices, row by row, of the plane's homogeneous coordinates; and a number's limits.

export const clamp = (x, least, most) => Math.min(most, Math.max(least, x));

export const multiply = (a, b) => a.map((_, i) => {
  const row = i - i % 3, column = i % 3;
  return a[row] * b[column] + a[row + 1] * b[column + 3] + a[row + 2] * b[column + 6];
});

export const translation = (x, y) => [1, 0, x, 0, 1, y, 0, 0, 1];
export const scaling = (x, y) => [x, 0, 0, 0, y, 0, 0, 0, 1];

export function rotation(angle) {
  const c = Math.cos(angle), s = Math.sin(angle);
  return [c, -s, 0, s, c, 0, 0, 0, 1];
}

// The adjugate, divided so that the last number is that of the true inverse.
export function inverse(m) {
  const [a, b, c, d, e, f, g, h, i] = m;
  const adjugate = [
    e * i - f * h, c * h - b * i, b * f - c * e, f * g - d * i, a * i - c * g, c * d - a * f, d * h - e * g, b * g - a * h,
    a * e - b * d];
  const determinant = a * adjugate[0] + b * adjugate[3] + c * adjugate[6];
  return adjugate.map((number) => number / determinant);
}

// Homogeneous coordinates of (x, y).
export const mapped = (m, x, y) => [0, 3, 6].map((row) => m[row] * x + m[row + 1] * y + m[row + 2]);

// As WebGL takes them: column by column.
export const byColumns = (m) => [0, 3, 6, 1, 4, 7, 2, 5, 8].map((i) => m[i]);

// As CSS takes them: a matrix of space that keeps z.
export const css = (m) => `matrix3d(${[m[0], m[3], 0, m[6], m[1], m[4], 0, m[7], 0, 0, 1, 0, m[2], m[5], 0, m[8]].join()})`;
