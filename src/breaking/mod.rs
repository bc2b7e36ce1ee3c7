//! Which bonds break as a body moves, and which have: what a march remembers beside displacements.
//!
//! Evaluating a force changes nothing, so a bond may not part while forces are summed. What breaks is committed at one
//! moment, when a step is done and the next has not begun ([`crate::march`]): a rule sees the state and sets bits of a
//! [`Broken`], which forces read at the next evaluation. A broken bond does not heal.

mod running_notch;
mod tip;

pub use running_notch::RunningNotches;

/// The bonds that have broken since the beginning, by bits.
///
/// Nodes whose bonds may break have some words each, with two bits for each bond of the half family: forward, then
/// backward. Both ends of a bond have their own bit; they are set together.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Broken {
    words: Vec<u64>,
}

/// Nothing has broken.
static NONE: Broken = Broken { words: Vec::new() };

impl Broken {
    /// Nothing has broken, in a body of which nothing may.
    pub fn none() -> &'static Self {
        &NONE
    }

    /// Bits of a word.
    #[inline]
    pub fn word(&self, index: usize) -> u64 {
        self.words.get(index).copied().unwrap_or(0)
    }

    /// How many ends of bonds have broken: each bond has two, or one in the body and one in an image of it.
    pub fn ends(&self) -> u32 {
        self.words.iter().map(|word| word.count_ones()).sum()
    }
}

/// Nodes whose bonds may break, and where each has its words.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Breakable {
    /// Numbers of their cells, rising.
    cells: Vec<usize>,
    /// Words of a node.
    words: usize,
}

impl Breakable {
    /// The cells of these numbers, in rising order, of a half family of so many bonds.
    fn new(cells: Vec<usize>, pairs: usize) -> Self {
        Self { cells, words: (2 * pairs).div_ceil(64) }
    }

    /// The first of a node's words, by the number of its cell; `None` where no bond may break.
    pub fn first_word(&self, cell: usize) -> Option<usize> {
        self.cells.binary_search(&cell).ok().map(|slot| slot * self.words)
    }

    /// How many nodes there are.
    pub fn count(&self) -> usize {
        self.cells.len()
    }

    fn intact(&self) -> Broken {
        Broken { words: vec![0; self.cells.len() * self.words] }
    }

    fn bytes(&self) -> usize {
        size_of_val(self.cells.as_slice()) + 8 * self.cells.len() * self.words
    }
}
