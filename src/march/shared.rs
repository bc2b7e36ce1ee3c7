//! A field on which several threads work at once, each on stretches of its own.

use std::marker::PhantomData;
use std::ops::Range;

/// A field lent to the tasks of a pass.
#[derive(Clone, Copy)]
pub struct Shared<'a> {
    first: *mut f64,
    len: usize,
    field: PhantomData<&'a mut [f64]>,
}

// SAFETY: whoever reads or writes a stretch promises that nobody else writes it at that time; f64 may be sent.
unsafe impl Send for Shared<'_> {}
// SAFETY: as above.
unsafe impl Sync for Shared<'_> {}

impl<'a> Shared<'a> {
    pub fn new(field: &'a mut [f64]) -> Self {
        Self { first: field.as_mut_ptr(), len: field.len(), field: PhantomData }
    }

    /// # Safety
    /// Nobody writes into the stretch while the slice is alive.
    pub unsafe fn read(&self, places: Range<usize>) -> &'a [f64] {
        assert!(places.start <= places.end && places.end <= self.len);
        // SAFETY: within the field; the rest is the caller's.
        unsafe { std::slice::from_raw_parts(self.first.add(places.start), places.len()) }
    }

    /// # Safety
    /// Nobody reads or writes the stretch while the slice is alive.
    pub unsafe fn write(&self, places: Range<usize>) -> &'a mut [f64] {
        assert!(places.start <= places.end && places.end <= self.len);
        // SAFETY: within the field; the rest is the caller's.
        unsafe { std::slice::from_raw_parts_mut(self.first.add(places.start), places.len()) }
    }
}
