//! Shards of a batch, for separate processes or machines.

use crate::digest::sha256;
use std::fmt;
use std::str::FromStr;

/// Greatest number of shards.
const MAX_SHARDS: u32 = 100_000;

/// A shard of the jobs: `2/8` is the second of eight.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Shard {
    /// Index, from 1 to `of`.
    index: u32,
    of: u32,
}

impl Shard {
    /// All jobs.
    pub const WHOLE: Self = Self { index: 1, of: 1 };

    /// Returns whether a job belongs to this shard.
    pub(super) fn holds(self, job: &str) -> bool {
        let digest = sha256(job.as_bytes());
        let number = digest[..8].iter().fold(0_u64, |number, byte| number << 8 | u64::from(*byte));
        number % u64::from(self.of) == u64::from(self.index - 1)
    }

    /// Returns the name of the shard's manifest, without the extension.
    pub(super) fn manifest(self) -> String {
        match self {
            Self::WHOLE => "manifest".to_owned(),
            Self { index, of } => format!("manifest-{index}-of-{of}"),
        }
    }
}

impl FromStr for Shard {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        let numbers = text.split_once('/').and_then(|(i, n)| Some((i.parse().ok()?, n.parse().ok()?)));
        match numbers {
            Some((index, of)) if (1..=of).contains(&index) && of <= MAX_SHARDS => Ok(Self { index, of }),
            _ => Err("I/N was expected, with I from 1 to N, as in 2/8".into()),
        }
    }
}

impl fmt::Display for Shard {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}/{}", self.index, self.of)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_job_is_in_one_share_and_shares_are_about_equal() {
        let shards: Vec<Shard> = (1..=4).map(|i| format!("{i}/4").parse().unwrap()).collect();
        let jobs: Vec<String> = (0..1000).map(|i| format!("old/clip-{i}.bvh")).collect();
        for job in &jobs {
            assert_eq!(shards.iter().filter(|shard| shard.holds(job)).count(), 1);
        }
        for shard in shards {
            let share = jobs.iter().filter(|job| shard.holds(job)).count();
            assert!((200..300).contains(&share), "{shard}: {share}");
        }
    }

    #[test]
    fn shares_have_manifests_of_their_own() {
        assert_eq!("2/8".parse::<Shard>().unwrap().manifest(), "manifest-2-of-8");
        assert_eq!("1/1".parse::<Shard>().unwrap().manifest(), "manifest");
        for bad in ["", "0/4", "5/4", "1", "1/0", "a/b", "-1/4"] {
            assert!(bad.parse::<Shard>().is_err(), "{bad}");
        }
    }
}
