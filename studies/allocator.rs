//! The allocator: memory that the system does not give ends the run with a message and code 3, in place of an abort.
//!
//! What needs more than there is should have been refused beforehand ([`crate::afford`]); this is for what others took
//! in the meantime. Folders of results that are finished stay, as after any failure.

use std::alloc::{GlobalAlloc, Layout, System};
use std::io::Write;
use std::sync::atomic::{AtomicBool, Ordering};
use std::time::Duration;

/// The system's allocator, or the end.
struct OrEnd;

#[global_allocator]
static ALLOCATOR: OrEnd = OrEnd;

/// Whether a thread is ending the process for want of memory.
static ENDING: AtomicBool = AtomicBool::new(false);

// SAFETY: every call is handed to the system's allocator as it came; where that gives nothing the process ends.
unsafe impl GlobalAlloc for OrEnd {
    unsafe fn alloc(&self, layout: Layout) -> *mut u8 {
        // SAFETY: the caller's promises about the layout are those that the system's allocator asks for.
        given(unsafe { System.alloc(layout) }, layout.size())
    }

    unsafe fn alloc_zeroed(&self, layout: Layout) -> *mut u8 {
        // SAFETY: as above.
        given(unsafe { System.alloc_zeroed(layout) }, layout.size())
    }

    unsafe fn realloc(&self, old: *mut u8, layout: Layout, size: usize) -> *mut u8 {
        // SAFETY: as above; `old` came from the same allocator.
        given(unsafe { System.realloc(old, layout, size) }, size)
    }

    unsafe fn dealloc(&self, old: *mut u8, layout: Layout) {
        // SAFETY: as above.
        unsafe { System.dealloc(old, layout) }
    }
}

#[inline]
fn given(memory: *mut u8, bytes: usize) -> *mut u8 {
    if memory.is_null() { ended(bytes) } else { memory }
}

/// Says so, and ends with the code of a computation that failed. Nothing here asks for memory.
#[cold]
fn ended(bytes: usize) -> ! {
    if ENDING.swap(true, Ordering::SeqCst) {
        // Another thread is ending it; if it is this one, which needed memory to say so, nothing more can be said.
        std::thread::sleep(Duration::from_secs(2));
        std::process::abort();
    }
    let mut stderr = std::io::stderr();
    let _ = writeln!(stderr, "error: the system gives no more memory; {bytes} bytes were asked for");
    let _ = writeln!(stderr, "help: take fewer nodes, snapshots or --threads, or end what else is running");
    std::process::exit(3)
}
