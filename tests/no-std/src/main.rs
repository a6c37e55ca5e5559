//! The probe as a static program without std, allocator and C runtime. Its exit code is the result
//! of [`asperity_no_std::run`].
#![no_std]
#![no_main]

use core::arch::asm;

/// The entry point: aligns the stack, runs the probe, exits the process.
#[unsafe(no_mangle)]
#[unsafe(naked)]
extern "C" fn _start() -> ! {
    core::arch::naked_asm!("and rsp, -16", "call {main}", "ud2", main = sym main)
}

extern "C" fn main() -> ! {
    let code = asperity_no_std::run();
    // exit_group(code) of x86-64 Linux.
    unsafe { asm!("syscall", in("rax") 231, in("rdi") code, options(noreturn)) }
}

/// Required by the precompiled core library; never called, because a panic aborts.
#[unsafe(no_mangle)]
extern "C" fn rust_eh_personality() {}

macro_rules! bytes {
    ($($name:ident($($argument:ident: $type:ty),*) -> $result:ty $body:block)*) => {$(
        /// A byte-wise memory function that compiled code may call.
        ///
        /// # Safety
        ///
        /// Same as for the C function of this name.
        #[unsafe(no_mangle)]
        unsafe extern "C" fn $name($($argument: $type),*) -> $result { unsafe { $body } }
    )*};
}

bytes! {
    memcpy(to: *mut u8, from: *const u8, n: usize) -> *mut u8 {
        memmove(to, from, n)
    }
    memset(to: *mut u8, value: i32, n: usize) -> *mut u8 {
        let mut i = 0;
        while i < n {
            to.add(i).write_volatile(value as u8);
            i += 1;
        }
        to
    }
    memmove(to: *mut u8, from: *const u8, n: usize) -> *mut u8 {
        let forwards = (to as usize) < from as usize;
        let mut k = 0;
        while k < n {
            let i = if forwards { k } else { n - 1 - k };
            to.add(i).write_volatile(from.add(i).read());
            k += 1;
        }
        to
    }
    bcmp(a: *const u8, b: *const u8, n: usize) -> i32 {
        memcmp(a, b, n)
    }
    memcmp(a: *const u8, b: *const u8, n: usize) -> i32 {
        let mut i = 0;
        while i < n {
            let difference = i32::from(a.add(i).read()) - i32::from(b.add(i).read());
            if difference != 0 {
                return difference;
            }
            i += 1;
        }
        0
    }
}
