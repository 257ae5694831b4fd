// The least D of every pixel of a picture. A query is a column; windows are on lines, ascending by ones. No D is
// stored. Requires sums.wgsl. CPU twin: atlas.rs.

// The first tile of windows, and the number of lines of the picture.
struct View { tile: u32, height: u32, unused: vec2u }

// Line of each window; the largest number for none.
@group(0) @binding(4) var<storage, read> lines: array<u32>;
// Bits of D, column by column. The bits of nonnegative numbers have the same order as the numbers.
@group(0) @binding(5) var<storage, read_write> picture: array<atomic<u32>>;
@group(0) @binding(6) var<uniform> view: View;

const NONE = 0xffffffffu;

// The least D of each query and line.
var<workgroup> best: array<atomic<u32>, 1024>;
// The first line of the tile.
var<workgroup> first_line: u32;

@compute @workgroup_size(8, 8)
fn main(@builtin(workgroup_id) tile: vec3u, @builtin(local_invocation_id) thread: vec3u,
        @builtin(local_invocation_index) lane: u32) {
  let w0 = (view.tile + tile.x) * TILE;
  let q0 = tile.y * TILE;
  for (var i = lane; i < TILE * TILE; i += 64u) {
    atomicStore(&best[i], NONE);
  }
  if lane == 0u {
    var first = NONE;
    for (var i = 0u; i < TILE; i++) {
      first = min(first, lines[w0 + i]);
    }
    first_line = first;
  }
  // Its barriers come after these stores.
  var sums = sums_of(q0, w0, thread, lane);
  for (var i = 0u; i < 4u; i++) {
    let row = thread.y + 8u * i;
    for (var j = 0u; j < 4u; j++) {
      let w = w0 + thread.x + 8u * j;
      let line = lines[w];
      if line == NONE {
        continue;
      }
      let d = distance_of(q0 + row, w, sums.h[i][j], sums.re[i][j], sums.im[i][j]);
      atomicMin(&best[row * TILE + line - first_line], bitcast<u32>(d));
    }
  }
  workgroupBarrier();
  for (var i = lane; i < TILE * TILE; i += 64u) {
    let d = atomicLoad(&best[i]);
    if d != NONE {
      atomicMin(&picture[(q0 + i / TILE) * view.height + first_line + i % TILE], d);
    }
  }
}
