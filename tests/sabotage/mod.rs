//! Deliberate faults.
