//! does = "It brings its own allocator."
//! into = "sphere.rs"
//! verdicts = ["not_compiled"]
//! slow = true
//!
//! [points]
//! sphere = 0

struct Mine;
unsafe impl std::alloc::GlobalAlloc for Mine {
    unsafe fn alloc(&self, _: std::alloc::Layout) -> *mut u8 {
        std::ptr::null_mut()
    }
    unsafe fn dealloc(&self, _: *mut u8, _: std::alloc::Layout) {}
}
#[global_allocator]
static MINE: Mine = Mine;
