// Every D between queries and windows, a row of all windows for each query. Requires sums.wgsl. CPU twin: distances.rs.

@group(0) @binding(4) var<storage, read_write> distances: array<f32>;

@compute @workgroup_size(8, 8)
fn main(@builtin(workgroup_id) tile: vec3u, @builtin(local_invocation_id) thread: vec3u,
        @builtin(local_invocation_index) lane: u32) {
  let w0 = tile.x * TILE;
  let q0 = tile.y * TILE;
  var sums = sums_of(q0, w0, thread, lane);
  for (var i = 0u; i < 4u; i++) {
    let q = q0 + thread.y + 8u * i;
    for (var j = 0u; j < 4u; j++) {
      let w = w0 + thread.x + 8u * j;
      distances[q * arrayLength(&windows) + w] = distance_of(q, w, sums.h[i][j], sums.re[i][j], sums.im[i][j]);
    }
  }
}
