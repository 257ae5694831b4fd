//! The core behind handles and typed arrays, for JavaScript; no algorithm.
