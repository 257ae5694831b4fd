/** Densities over a rectangle, and contour lines of a grid. */

/** Values on a grid, row after row from the top left. */
export interface Grid {
  columns: number;
  rows: number;
  values: Float32Array;
}

/** Standard deviation of the kernel, cells. */
const BLUR = 2.4;

/**
 * Density of points in the unit square, 1 at its maximum.
 *
 * @param points - x and y alternating, 0–1 from the top left.
 */
export function density(points: ArrayLike<number>, columns: number, rows: number): Grid {
  const values = new Float32Array(columns * rows);
  for (let i = 0; i + 1 < points.length; i += 2) {
    // Bilinear weights: a point is distributed to its four grid points.
    const [x, y] = [points[i]! * (columns - 1), points[i + 1]! * (rows - 1)];
    const [column, row] = [Math.floor(x), Math.floor(y)];
    for (const [c, r] of [
      [column, row],
      [column + 1, row],
      [column, row + 1],
      [column + 1, row + 1],
    ] as const)
      if (c >= 0 && c < columns && r >= 0 && r < rows)
        values[r * columns + c]! += (1 - Math.abs(x - c)) * (1 - Math.abs(y - r));
  }
  blur(values, columns, rows, 1, columns);
  blur(values, rows, columns, columns, 1);
  const max = values.reduce((a, b) => Math.max(a, b), 0);
  if (max > 0) for (let i = 0; i < values.length; i++) values[i]! /= max;
  return { columns, rows, values };
}

/** Blurs a grid along its lines. */
function blur(values: Float32Array, length: number, lines: number, step: number, stride: number): void {
  const reach = Math.ceil(3 * BLUR);
  const kernel = Float32Array.from({ length: 2 * reach + 1 }, (_, i) => Math.exp(-0.5 * ((i - reach) / BLUR) ** 2));
  const line = new Float32Array(length);
  for (let l = 0; l < lines; l++) {
    for (let i = 0; i < length; i++) line[i] = values[l * stride + i * step]!;
    for (let i = 0; i < length; i++) {
      let sum = 0;
      for (let k = -reach; k <= reach; k++) sum += (line[i + k] ?? 0) * kernel[k + reach]!;
      values[l * stride + i * step] = sum;
    }
  }
}

/** A closed line: x and y alternating, 0–1 from the grid's top left. */
export type Loop = number[];

/**
 * The lines that enclose the area above a level. Cells beyond the grid count as below the level, so lines close along
 * its edge.
 */
export function contour({ columns, rows, values }: Grid, level: number): Loop[] {
  const width = columns + 2;
  const min = values.reduce((a, b) => Math.min(a, b), level);
  const outside = Math.min(min, level) - Math.max(1e-6, Math.abs(level - min));
  const at = (column: number, row: number): number => {
    const inside = column >= 1 && column <= columns && row >= 1 && row <= rows;
    return inside ? values[(row - 1) * columns + column - 1]! : outside;
  };
  // Edges of cells by index: from a corner to the right, or down.
  const right = (column: number, row: number) => 2 * (row * width + column);
  const down = (column: number, row: number) => right(column, row) + 1;
  const next = new Map<number, number>();
  // Most cells have no line: they are skipped before allocating anything.
  const isAbove = new Uint8Array(width * (rows + 2));
  for (let row = 1; row <= rows; row++)
    for (let column = 1; column <= columns; column++)
      isAbove[row * width + column] = values[(row - 1) * columns + column - 1]! >= level ? 1 : 0;
  for (let row = 0; row <= rows; row++)
    for (let column = 0; column <= columns; column++) {
      const corner = row * width + column;
      const sum = isAbove[corner]! + isAbove[corner + 1]! + isAbove[corner + width]! + isAbove[corner + width + 1]!;
      if (sum === 0 || sum === 4) continue;
      const corners = [at(column, row), at(column + 1, row), at(column + 1, row + 1), at(column, row + 1)];
      const edges = [right(column, row), down(column + 1, row), right(column, row + 1), down(column, row)];
      const above = corners.map((value) => value >= level);
      const middle = corners.reduce((a, b) => a + b, 0) / 4 >= level;
      // A line leaves through an edge whose first corner is above, and enters where it is below.
      const leaving = [0, 1, 2, 3].filter((i) => above[i] && !above[(i + 1) % 4]);
      for (const out of leaving) {
        // Going round from there, it entered at the previous such edge, or in a saddle whose middle is above at the
        // next one.
        const turns = middle && leaving.length === 2 ? [1, 2, 3] : [3, 2, 1];
        const into = turns.map((by) => (out + by) % 4).find((i) => !above[i] && above[(i + 1) % 4])!;
        next.set(edges[into]!, edges[out]!);
      }
    }
  const point = (edge: number): [number, number] => {
    const corner = Math.floor(edge / 2);
    const [column, row] = [corner % width, Math.floor(corner / width)];
    const [dx, dy] = edge % 2 === 0 ? [1, 0] : [0, 1];
    const [a, b] = [at(column, row), at(column + dx, row + dy)];
    const share = (level - a) / (b - a);
    const clamped = (v: number) => Math.min(1, Math.max(0, v));
    return [clamped((column - 1 + dx * share) / (columns - 1)), clamped((row - 1 + dy * share) / (rows - 1))];
  };
  const loops: Loop[] = [];
  while (next.size > 0) {
    const loop: Loop = [];
    let edge: number | undefined = next.keys().next().value;
    while (edge !== undefined && next.has(edge)) {
      loop.push(...point(edge));
      const following: number = next.get(edge)!;
      next.delete(edge);
      edge = following;
    }
    loops.push(loop);
  }
  return loops;
}

/** Whether a point is enclosed by loops; loops inside others are holes. */
export function encloses(loops: readonly Loop[], x: number, y: number): boolean {
  let inside = false;
  for (const loop of loops)
    for (let i = 0, j = loop.length - 2; i < loop.length; j = i, i += 2) {
      const [ax, ay, bx, by] = [loop[i]!, loop[i + 1]!, loop[j]!, loop[j + 1]!];
      if (ay > y !== by > y && x < ((bx - ax) * (y - ay)) / (by - ay) + ax) inside = !inside;
    }
  return inside;
}
