//! The allocator of the C library, told to keep what it is given back.

/// Buffers up to this size are carved from memory that the process has, bytes; it is the most that the C library takes.
#[cfg(all(target_os = "linux", target_env = "gnu"))]
const CARVED_UP_TO: libc::c_int = 32 << 20;
/// Memory at the end of the heap that is kept when it is free, bytes.
#[cfg(all(target_os = "linux", target_env = "gnu"))]
const KEPT: libc::c_int = 64 << 20;

/// Keeps freed buffers for the next row group: given back, each of their pages would be cleared by the kernel again, which
/// costs as much as decoding. To be called before threads start.
pub fn keep_freed_buffers() {
    #[cfg(all(target_os = "linux", target_env = "gnu"))]
    #[expect(unsafe_code, reason = "mallopt is C; it only sets two numbers, and takes any")]
    unsafe {
        libc::mallopt(libc::M_MMAP_THRESHOLD, CARVED_UP_TO);
        libc::mallopt(libc::M_TRIM_THRESHOLD, KEPT);
    }
}
