// The sums of 32 queries and 32 windows from which D is computed, included before the kernels that need D. A workgroup
// of 8 × 8 threads processes a tile, a thread four queries by four windows of it. CPU twin: strut-core's
// search/packed.rs.

struct Window { travel: array<vec4f, 2>, norm: f32, end: u32, unused: vec2u }

@group(0) @binding(0) var<storage, read> rows: array<vec4f>;
@group(0) @binding(1) var<storage, read> windows: array<Window>;
@group(0) @binding(2) var<storage, read> query_rows: array<vec4f>;
@group(0) @binding(3) var<storage, read> queries: array<Window>;

// Vectors of a row: five of heights, five of x, five of z.
const ROW = 15u;
const TILE = 32u;
const PARTS = 5u;

// The tile's heights of one frame, or its x and then its z: vector 32 p + i is part p of query i.
var<workgroup> a: array<vec4f, 320>;
// The same for its windows.
var<workgroup> b: array<vec4f, 320>;

// Sums for a thread's queries (y + 8 i) and windows (x + 8 j), without their translation: products of heights, and both
// components of the ground products.
struct Sums { h: array<vec4f, 4>, re: array<vec4f, 4>, im: array<vec4f, 4> }

fn four_dots(v: vec4f, at: u32) -> vec4f {
  return vec4f(dot(v, b[at]), dot(v, b[at + 8u]), dot(v, b[at + 16u]), dot(v, b[at + 24u]));
}

// Must be called by the whole workgroup. q0 and w0 are the tile's first query and window.
fn sums_of(q0: u32, w0: u32, thread: vec3u, lane: u32) -> Sums {
  let x = thread.x;
  let y = thread.y;
  var sums: Sums;
  for (var f = 0u; f < 5u; f++) {
    for (var i = lane; i < PARTS * TILE; i += 64u) {
      a[i] = query_rows[(queries[q0 + i % TILE].end + f - 4u) * ROW + i / TILE];
      b[i] = rows[(windows[w0 + i % TILE].end + f - 4u) * ROW + i / TILE];
    }
    workgroupBarrier();
    for (var p = 0u; p < PARTS * TILE; p += TILE) {
      for (var i = 0u; i < 4u; i++) {
        sums.h[i] += four_dots(a[p + y + 8u * i], p + x);
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
        sums.re[i] += four_dots(ax, p + x) + four_dots(az, z + x);
        sums.im[i] += four_dots(ax, z + x) - four_dots(az, p + x);
      }
    }
    workgroupBarrier();
  }
  return sums;
}

// D of query q and window w, m², from their sums.
fn distance_of(q: u32, w: u32, h: f32, re: f32, im: f32) -> f32 {
  let qx = queries[q].travel[0];
  let qz = queries[q].travel[1];
  let wx = windows[w].travel[0];
  let wz = windows[w].travel[1];
  let g = vec2f(re + dot(qx, wx) + dot(qz, wz), im + dot(qx, wz) - dot(qz, wx));
  // A root of 0 need not be accurate.
  let turned = sqrt(max(g.x * g.x + g.y * g.y, 1e-30));
  // The bits of nonnegative numbers have the same order as the numbers; -0 would come last.
  return abs(max(queries[q].norm + windows[w].norm - 2.0 * (h + turned), 0.0));
}
