//! One of n parts of a run: cases are dealt by a hash of their names, so that a new study moves no old case.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use sha2::{Digest, Sha256};
use std::fmt;
use std::str::FromStr;

/// More parts than this are no run.
const MOST: u32 = 100_000;

/// Part `part` of `of`, counted from 1.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Shard {
    pub part: u32,
    pub of: u32,
}

impl Shard {
    /// Whether this part runs the case.
    pub fn takes(self, study: &str, case: &str) -> bool {
        let digest = Sha256::digest(format!("{study}/{case}").as_bytes());
        let head = digest.iter().take(8).fold(0_u64, |sum, byte| sum << 8 | u64::from(*byte));
        head % u64::from(self.of) == u64::from(self.part - 1)
    }
}

impl fmt::Display for Shard {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}/{}", self.part, self.of)
    }
}

impl FromStr for Shard {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        let wrong =
            || format!("\"{text}\" is no part of a run: write k/n with 1 ≤ k ≤ n ≤ {MOST}, as in 2/8");
        let (part, of) = text.split_once('/').ok_or_else(wrong)?;
        let (part, of) = (part.parse().map_err(|_| wrong())?, of.parse().map_err(|_| wrong())?);
        if (1..=of).contains(&part) && of <= MOST { Ok(Self { part, of }) } else { Err(wrong()) }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The first eight bytes of SHA-256("mine/a"), as `sha256sum` gives them, are 6725cf0f44211e46: 0 more than a multiple
    /// of 2, 2 more than one of 3, 1 more than one of 7.
    #[test]
    fn a_case_belongs_to_one_part_whatever_else_there_is() {
        let parts = |of| (1..=of).map(move |part| Shard { part, of });
        for (part, of) in [(1, 2), (3, 3), (2, 7)] {
            assert!(Shard { part, of }.takes("mine", "a"));
        }
        for n in 0..200 {
            let case = format!("a{n}");
            assert_eq!(parts(7).filter(|shard| shard.takes("mine", &case)).count(), 1);
        }
        let shares: Vec<usize> = parts(4)
            .map(|shard| (0..4000).filter(|n| shard.takes("mine", &format!("a{n}"))).count())
            .collect();
        assert!(shares.iter().all(|share| (850..1150).contains(share)), "{shares:?}");
    }

    #[test]
    fn what_is_no_part_is_refused() {
        assert_eq!("3/8".parse(), Ok(Shard { part: 3, of: 8 }));
        for text in ["", "3", "0/3", "4/3", "1/0", "-1/3", "1/2/3", "a/b", "1/4294967296", "1/1000000"] {
            assert!(text.parse::<Shard>().is_err(), "{text}");
        }
    }
}
