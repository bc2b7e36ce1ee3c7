//! Numbers side by side: one code for every instruction set, chosen when the program runs.
//!
//! A [`Kernel`] is written once over [`Lanes`], a few f64 that a processor handles at a time. [`Isa::run`] compiles it for
//! AVX-512, for AVX2 with fused multiply-add, and for every other processor, and calls the one asked for. Lanes never mix
//! but where a kernel shifts them, so a node's bits do not depend on the lane it falls in; they do depend on whether
//! multiplication and addition round once or twice, and so on the instruction set.

mod lanes;
mod plain;
#[cfg(target_arch = "x86_64")]
mod x86;

pub use lanes::Lanes;
pub use plain::Plain;
use std::sync::OnceLock;

/// The words of `--isa`.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub enum InstructionSet {
    /// What every processor of its architecture has.
    Baseline,
    /// AVX2 with fused multiply-add.
    Avx2,
    /// AVX-512 F, DQ and VL.
    Avx512,
}

impl InstructionSet {
    /// Slowest first.
    pub const ALL: [Self; 3] = [Self::Baseline, Self::Avx2, Self::Avx512];

    /// In options, manifests and benchmarks.
    pub fn name(self) -> &'static str {
        match self {
            Self::Baseline => "baseline",
            Self::Avx2 => "avx2",
            Self::Avx512 => "avx512",
        }
    }

    /// Whether this processor has it.
    pub fn is_here(self) -> bool {
        match self {
            Self::Baseline => true,
            #[cfg(target_arch = "x86_64")]
            Self::Avx2 => is_x86_feature_detected!("avx2") && is_x86_feature_detected!("fma"),
            #[cfg(target_arch = "x86_64")]
            Self::Avx512 => {
                Self::Avx2.is_here()
                    && is_x86_feature_detected!("avx512f")
                    && is_x86_feature_detected!("avx512dq")
                    && is_x86_feature_detected!("avx512vl")
            }
            #[cfg(not(target_arch = "x86_64"))]
            _ => false,
        }
    }
}

/// An instruction set that this processor has: there is no other way to make one.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Isa {
    set: InstructionSet,
    /// Whether plain code stands in for its registers.
    #[cfg(debug_assertions)]
    mirrored: bool,
}

/// What [`Isa::pin`] was given.
static PINNED: OnceLock<Isa> = OnceLock::new();

impl Isa {
    /// `None` where the processor lacks it.
    pub fn of(set: InstructionSet) -> Option<Self> {
        set.is_here().then_some(Self::new(set))
    }

    /// The best of this processor.
    pub fn best() -> Self {
        InstructionSet::ALL
            .into_iter()
            .rev()
            .find_map(Self::of)
            .unwrap_or(Self::new(InstructionSet::Baseline))
    }

    /// All of this processor.
    pub fn all() -> impl Iterator<Item = Self> {
        InstructionSet::ALL.into_iter().filter_map(Self::of)
    }

    /// What models are made for from now on, in the whole process: once, as the number of threads. `false` where that was
    /// said before.
    pub fn pin(self) -> bool {
        PINNED.set(self).is_ok()
    }

    /// The pinned one, or the best.
    pub fn chosen() -> Self {
        PINNED.get().copied().unwrap_or_else(Self::best)
    }

    pub fn set(self) -> InstructionSet {
        self.set
    }

    /// How many f64 its kernels handle side by side.
    pub fn lanes(self) -> usize {
        if self.set == InstructionSet::Avx512 { 8 } else { 4 }
    }

    fn new(set: InstructionSet) -> Self {
        Self {
            set,
            #[cfg(debug_assertions)]
            mirrored: false,
        }
    }

    /// The arithmetic of AVX2 and of AVX-512 in plain code with every access checked, in builds with debug assertions: what
    /// vector registers are held against.
    #[cfg(debug_assertions)]
    pub fn mirror() -> Self {
        Self { set: InstructionSet::Baseline, mirrored: true }
    }

    /// Runs a kernel compiled for it.
    #[inline]
    pub fn run<K: Kernel>(self, kernel: K) -> K::Output {
        #[cfg(debug_assertions)]
        if self.mirrored {
            return kernel.run::<Plain<4, true>>();
        }
        match self.set {
            InstructionSet::Baseline => kernel.run::<Plain<4, false>>(),
            // SAFETY: an `Isa` is made only where `is_here` found these features.
            #[cfg(target_arch = "x86_64")]
            InstructionSet::Avx2 => unsafe { x86::avx2(kernel) },
            // SAFETY: as above.
            #[cfg(target_arch = "x86_64")]
            InstructionSet::Avx512 => unsafe { x86::avx512(kernel) },
            #[cfg(not(target_arch = "x86_64"))]
            _ => kernel.run::<Plain<4, false>>(),
        }
    }
}

/// Work on many numbers, written once for all instruction sets. `run` and all that it calls in its loops are to be
/// `#[inline(always)]`, or they are compiled for none.
pub trait Kernel {
    type Output;

    fn run<V: Lanes>(self) -> Self::Output;
}
