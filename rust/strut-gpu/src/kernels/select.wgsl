// Candidates of each class and query: the windows within the distance of the k-th nearest plus a margin, found by 256
// threads. CPU twin: select.rs.

// Range of a class in a row of distances, its number of windows, and k, at least 1 if there are windows.
struct Class { first: u32, count: u32, wanted: u32, unused: u32 }

// Bits of distances, a row of `stride` for each query.
@group(0) @binding(0) var<storage, read> distances: array<u32>;
@group(0) @binding(1) var<storage, read> classes: array<Class>;
// Margin of each query and class.
@group(0) @binding(2) var<storage, read> margins: array<f32>;
// For each query and class: the number of candidates, and the first 128 in any order.
@group(0) @binding(3) var<storage, read_write> found: array<u32>;
@group(0) @binding(4) var<uniform> stride: vec4u;

const THREADS = 256u;
const PLACES = 128u;

var<workgroup> counts: array<atomic<u32>, 2048>;
var<workgroup> sums: array<u32, THREADS>;
// Leading bits of the k-th least distance, and its rank among the distances with these bits.
var<workgroup> prefix: u32;
var<workgroup> rank: u32;
var<workgroup> taken: atomic<u32>;

@compute @workgroup_size(256)
fn main(@builtin(workgroup_id) group: vec3u, @builtin(local_invocation_index) lane: u32) {
  let class_ = classes[group.x];
  let base = group.y * stride.x + class_.first;
  let at = group.y * arrayLength(&classes) + group.x;
  if lane == 0u {
    prefix = 0u;
    rank = class_.wanted;
    atomicStore(&taken, 0u);
  }
  // The bits of a distance, of which the first is 0, in groups of eleven, ten and ten.
  var shift = 31u;
  for (var level = 0u; level < 3u; level++) {
    let bits = select(10u, 11u, level == 0u);
    let above = shift;
    shift -= bits;
    for (var i = lane; i < 2048u; i += THREADS) {
      atomicStore(&counts[i], 0u);
    }
    workgroupBarrier();
    for (var i = lane; i < class_.count; i += THREADS) {
      let key = distances[base + i];
      if key >> above == prefix {
        atomicAdd(&counts[extractBits(key, shift, bits)], 1u);
      }
    }
    workgroupBarrier();
    var sum = 0u;
    for (var i = 0u; i < 8u; i++) {
      sum += atomicLoad(&counts[8u * lane + i]);
    }
    sums[lane] = sum;
    workgroupBarrier();
    if lane == 0u {
      var left = rank;
      var bin = 0u;
      while bin < THREADS - 1u && sums[bin] < left {
        left -= sums[bin];
        bin++;
      }
      bin *= 8u;
      let end = bin + 7u;
      while bin < end && atomicLoad(&counts[bin]) < left {
        left -= atomicLoad(&counts[bin]);
        bin++;
      }
      prefix = (prefix << bits) | bin;
      rank = left;
    }
    workgroupBarrier();
  }
  let limit = bitcast<f32>(prefix) + margins[at];
  for (var i = lane; i < class_.count; i += THREADS) {
    if bitcast<f32>(distances[base + i]) <= limit {
      let place = atomicAdd(&taken, 1u);
      if place < PLACES {
        found[at * (PLACES + 1u) + 1u + place] = class_.first + i;
      }
    }
  }
  workgroupBarrier();
  if lane == 0u {
    found[at * (PLACES + 1u)] = atomicLoad(&taken);
  }
}
