//! Numbers in LEB128, and columns of them.

use crate::container::ContainerError;
use strut_core::database::MAX_FRAMES;

/// Appends a number.
pub(super) fn write_number(file: &mut Vec<u8>, mut number: u32) {
    while number > 0x7F {
        file.push(number as u8 | 0x80);
        number >>= 7;
    }
    file.push(number as u8);
}

/// Appends a column.
pub(super) fn write_column(file: &mut Vec<u8>, step: f32, values: impl Iterator<Item = f32>) {
    let [mut before, mut last] = [0_i32; 2];
    for value in values {
        let now = (f64::from(value) / f64::from(step)).round() as i32;
        let difference = now.wrapping_sub(last.wrapping_mul(2)).wrapping_add(before);
        write_number(file, ((difference << 1) ^ (difference >> 31)) as u32);
        [before, last] = [last, now];
    }
}

/// Bytes that are not yet read.
#[derive(Clone, Copy)]
pub(super) struct Reader<'a> {
    pub(super) rest: &'a [u8],
}

impl<'a> Reader<'a> {
    /// Returns an error instead of allocating for more numbers than the remaining bytes can contain, at least one byte
    /// each.
    pub(super) fn expect(&self, numbers: usize) -> Result<(), ContainerError> {
        if numbers > self.rest.len() { Err(ContainerError::Length) } else { Ok(()) }
    }

    /// The next `n` bytes.
    pub(super) fn bytes(&mut self, n: usize) -> Result<&'a [u8], ContainerError> {
        let (bytes, rest) = self.rest.split_at_checked(n).ok_or(ContainerError::Length)?;
        self.rest = rest;
        Ok(bytes)
    }

    /// The next `N` bytes.
    pub(super) fn array<const N: usize>(&mut self) -> Result<[u8; N], ContainerError> {
        let (bytes, rest) = self.rest.split_first_chunk().ok_or(ContainerError::Length)?;
        self.rest = rest;
        Ok(*bytes)
    }

    /// Next number, of at most 32 bits.
    pub(super) fn number(&mut self) -> Result<u32, ContainerError> {
        let mut number = 0;
        for shift in (0..32).step_by(7) {
            let [byte] = self.array()?;
            number |= u32::from(byte & 0x7F) << shift;
            if byte < 0x80 {
                return Ok(number);
            }
        }
        Err(ContainerError::Length)
    }

    /// The next column of `n` numbers.
    pub(super) fn column(&mut self, n: usize, step: f32) -> Result<impl Iterator<Item = f32> + use<>, ContainerError> {
        self.expect(n)?;
        let mut numbers = Vec::with_capacity(n);
        let [mut before, mut last] = [0_i32; 2];
        for _ in 0..n {
            let zigzag = self.number()?;
            let difference = (zigzag >> 1) as i32 ^ -((zigzag & 1) as i32);
            let now = difference.wrapping_add(last.wrapping_mul(2)).wrapping_sub(before);
            numbers.push(now as f32 * step);
            [before, last] = [last, now];
        }
        Ok(numbers.into_iter())
    }

    /// The next `columns` columns as `n` rows; the padding of rows is zero.
    pub(super) fn rows<const R: usize>(
        &mut self,
        n: usize,
        columns: usize,
        step: f32,
    ) -> Result<Vec<[f32; R]>, ContainerError> {
        self.expect(n.saturating_mul(columns))?;
        let mut rows = vec![[0.0; R]; n];
        for c in 0..columns {
            rows.iter_mut().zip(self.column(n, step)?).for_each(|(row, number)| row[c] = number);
        }
        Ok(rows)
    }

    /// Skips columns of `n` numbers.
    pub(super) fn skip(&mut self, n: usize, columns: usize) -> Result<(), ContainerError> {
        (0..n.min(MAX_FRAMES) * columns).try_for_each(|_| self.number().map(drop))
    }
}
