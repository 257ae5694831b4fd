// The least D of every pixel of a picture: 32 queries and 32 windows a workgroup of 8 by 8, four by four a thread. A query is
// a column; windows are on lines, ascending by ones. No D is stored. Twin: atlas.rs.

struct Window { travel: array<vec4f, 2>, norm: f32, end: u32, unused: vec2u }
// The first tile of windows, and lines of the picture.
struct View { tile: u32, height: u32, unused: vec2u }

@group(0) @binding(0) var<storage, read> rows: array<vec4f>;
@group(0) @binding(1) var<storage, read> windows: array<Window>;
@group(0) @binding(2) var<storage, read> query_rows: array<vec4f>;
@group(0) @binding(3) var<storage, read> queries: array<Window>;
// Of each window; the largest number for none.
@group(0) @binding(4) var<storage, read> lines: array<u32>;
// Bits of D, a column after the other: they order numbers that are not negative.
@group(0) @binding(5) var<storage, read_write> picture: array<atomic<u32>>;
@group(0) @binding(6) var<uniform> view: View;

const NONE = 0xffffffffu;

// Vectors of a row: five of heights, five of x, five of z.
const ROW = 15u;
const TILE = 32u;
const PARTS = 5u;

// The tile's heights of one frame, or its x and then its z: vector 32 p + i is part p of query i.
var<workgroup> a: array<vec4f, 320>;
// The same of its windows.
var<workgroup> b: array<vec4f, 320>;

// The least of each query and line.
var<workgroup> best: array<atomic<u32>, 1024>;
// The first line of the tile.
var<workgroup> first_line: u32;

fn four_dots(v: vec4f, at: u32) -> vec4f {
  return vec4f(dot(v, b[at]), dot(v, b[at + 8u]), dot(v, b[at + 16u]), dot(v, b[at + 24u]));
}

@compute @workgroup_size(8, 8)
fn main(@builtin(workgroup_id) tile: vec3u, @builtin(local_invocation_id) thread: vec3u,
        @builtin(local_invocation_index) lane: u32) {
  let w0 = (view.tile + tile.x) * TILE;
  let q0 = tile.y * TILE;
  let x = thread.x;
  let y = thread.y;
  var h: array<vec4f, 4>;
  var re: array<vec4f, 4>;
  var im: array<vec4f, 4>;
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
  for (var f = 0u; f < 5u; f++) {
    for (var i = lane; i < PARTS * TILE; i += 64u) {
      a[i] = query_rows[(queries[q0 + i % TILE].end + f - 4u) * ROW + i / TILE];
      b[i] = rows[(windows[w0 + i % TILE].end + f - 4u) * ROW + i / TILE];
    }
    workgroupBarrier();
    for (var p = 0u; p < PARTS * TILE; p += TILE) {
      for (var i = 0u; i < 4u; i++) {
        h[i] += four_dots(a[p + y + 8u * i], p + x);
      }
    }
    workgroupBarrier();
    for (var i = lane; i < 2u * PARTS * TILE; i += 64u) {
      a[i] = query_rows[(queries[q0 + i % TILE].end + f - 4u) * ROW + PARTS + i / TILE];
      b[i] = rows[(windows[w0 + i % TILE].end + f - 4u) * ROW + PARTS + i / TILE];
    }
    workgroupBarrier();
    for (var p = 0u; p < PARTS * TILE; p += TILE) {
      let z = p + PARTS * TILE;
      for (var i = 0u; i < 4u; i++) {
        let ax = a[p + y + 8u * i];
        let az = a[z + y + 8u * i];
        re[i] += four_dots(ax, p + x) + four_dots(az, z + x);
        im[i] += four_dots(ax, z + x) - four_dots(az, p + x);
      }
    }
    workgroupBarrier();
  }
  for (var i = 0u; i < 4u; i++) {
    let q = q0 + y + 8u * i;
    let qx = queries[q].travel[0];
    let qz = queries[q].travel[1];
    for (var j = 0u; j < 4u; j++) {
      let w = w0 + x + 8u * j;
      let line = lines[w];
      if line == NONE {
        continue;
      }
      let wx = windows[w].travel[0];
      let wz = windows[w].travel[1];
      let g = vec2f(re[i][j] + dot(qx, wx) + dot(qz, wz), im[i][j] + dot(qx, wz) - dot(qz, wx));
      // A root of 0 need not be accurate.
      let turned = sqrt(max(g.x * g.x + g.y * g.y, 1e-30));
      let d = max(queries[q].norm + windows[w].norm - 2.0 * (h[i][j] + turned), 0.0);
      // -0 would come last.
      atomicMin(&best[(y + 8u * i) * TILE + line - first_line], bitcast<u32>(abs(d)));
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
