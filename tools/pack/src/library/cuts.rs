//! What is cut from which file of the standard library, and why. [`super`] says why that is sound.

/// Texts of a file, and what becomes of each.
pub type Cuts = (&'static str, &'static [(&'static str, &'static str)]);

/// All files that are cut.
pub const CUTS: [Cuts; 20] = [
    (
        "std/src/thread/lifecycle.rs",
        &[
            // Nothing asks to be told of new threads: that is unstable.
            (
                "    let hooks = if no_hooks {
        spawnhook::ChildSpawnHooks::default()
    } else {
        spawnhook::run_spawn_hooks(&thread)
    };
",
                "",
            ),
            ("            crate::sys::backtrace::__rust_begin_short_backtrace(|| hooks.run());\n", ""),
            // No thread has a name, and those that draw bands never ask who they are: so none has a handle of its own.
            ("        if let Some(name) = self.handle.cname() {\n            imp::set_name(name);\n        }\n", ""),
            (
                "        if let Err(_thread) = set_current(self.handle.clone()) {
            // The current thread should not have set yet. Use an abort to save binary size (see #123356).
            rtabort!(\"current thread handle already set during thread spawn\");
        }
",
                "",
            ),
            ("    pub handle: Thread,\n", ""),
            ("ThreadInit { handle: thread.clone(), rust_start }", "ThreadInit { rust_start }"),
            ("    let id = ThreadId::new();\n    let thread = Thread::new(id, name);\n", ""),
            // Nobody waits for a thread but its scope. So its packet, which tells the scope that it has ended, is its own.
            ("    thread: Thread,\n    packet: Arc<Packet<'scope, T>>", "    packet: PhantomData<Packet<'scope, T>>"),
            ("        thread,\n        packet: my_packet", "        packet: PhantomData"),
            (
                "    let my_packet: Arc<Packet<'scope, T>> =
        Arc::new(Packet { scope: scope_data, result: UnsafeCell::new(None), _marker: PhantomData });
    let their_packet = my_packet.clone();
",
                "    let their_packet: Packet<'scope, T> =
        Packet { scope: scope_data, result: UnsafeCell::new(ManuallyDrop::new(None)), _marker: PhantomData };
    let scope = their_packet.scope.as_ref().map(|scope| {
        scope.increment_num_running_threads();
        &raw const **scope
    });
",
            ),
            (
                "    if let Some(scope_data) = &my_packet.scope {
        scope_data.increment_num_running_threads();
    }
",
                "",
            ),
            // A thread that does not start leaves its memory behind, the packet in it.
            (
                "        native: unsafe { imp::Thread::new(stack_size, init)? },\n",
                "        native: match unsafe { imp::Thread::new(stack_size, init) } {
            Ok(native) => native,
            Err(error) => {
                scope.map(|scope| unsafe { (*scope).decrement_num_running_threads(false) });
                return Err(error);
            }
        },
",
            ),
            ("        Arc::strong_count(&self.packet) == 1\n", "        unreachable!()\n"),
            (
                "        self.native.join();
        Arc::get_mut(&mut self.packet)
            // FIXME(fuzzypixelz): returning an error instead of panicking here
            // would require updating the documentation of
            // `std::thread::Result`; currently we can return `Err` if and only
            // if the thread had panicked.
            .expect(\"threads should not terminate unexpectedly\")
            .result
            .get_mut()
            .take()
            .unwrap()
",
                "        unreachable!()\n",
            ),
            ("        &self.thread\n", "        unreachable!()\n"),
            // No thread gives a result, and a panic ends the process.
            ("        unsafe { *their_packet.result.get() = Some(try_result) };\n", ""),
            ("    result: UnsafeCell<Option<Result<T>>>,", "    result: UnsafeCell<ManuallyDrop<Option<Result<T>>>>,"),
            ("matches!(self.result.get_mut(), Some(Err(_)))", "false"),
            ("            *self.result.get_mut() = None;\n", ""),
        ],
    ),
    (
        "std/src/sys/thread/unix.rs",
        &[
            // Threads have the stack that the system gives by itself: as much as the first thread, or 2 MB.
            ("        let mut attr: mem::MaybeUninit<libc::pthread_attr_t> = mem::MaybeUninit::uninit();\n", ""),
            ("        assert_eq!(libc::pthread_attr_init(attr.as_mut_ptr()), 0);\n", ""),
            (
                "        let mut attr = DropGuard::new(&mut attr, |attr| {
            assert_eq!(libc::pthread_attr_destroy(attr.as_mut_ptr()), 0)
        });
",
                "",
            ),
            ("let stack_size = cmp::max(stack, min_stack_size(attr.as_ptr()));", "let stack_size = stack;"),
            ("match libc::pthread_attr_setstacksize(attr.as_mut_ptr(), stack_size) {", "match 0 {"),
            ("if libc::pthread_attr_setstacksize(attr.as_mut_ptr(), stack_size) != 0 {", "if false {"),
            ("attr.as_ptr(), thread_start", "ptr::null(), thread_start"),
            // See above.
            ("            drop(Box::from_raw(data));\n", ""),
            // No handler tells a stack overflow from other faults.
            ("let _handler = sys::stack_overflow::Handler::new();", ""),
        ],
    ),
    (
        "std/src/sys/alloc/unix.rs",
        // One way to memory for every alignment up to 64, which all of it has: from `malloc`, whose word for where it began
        // stands before it. `aligned_alloc` takes nothing from what the thread itself has freed: 1.05 of the speed in the flight.
        // No request is so large that 64 bytes more overflow.
        &[
            (
                "        if layout.align() <= MIN_ALIGN && layout.align() <= layout.size() {
            unsafe { libc::malloc",
                "        if false {
            unsafe { libc::malloc",
            ),
            (
                "        if layout.align() <= MIN_ALIGN && layout.align() <= layout.size() {
            unsafe { libc::calloc",
                "        if false {
            unsafe { libc::calloc",
            ),
            ("layout.align() <= MIN_ALIGN && layout.align() <= new_size", "false"),
            ("let mut out = ptr::null_mut();", ""),
            (
                "            let ret = unsafe { libc::posix_memalign(&mut out, align, layout.size()) };
            if ret != 0 { ptr::null_mut() } else { out as *mut u8 }
",
                "            let start = unsafe { libc::malloc(layout.size() + 64) } as *mut u8;
            if start.is_null() {
                return start;
            }
            let place = (start as usize & !63) + 64;
            unsafe { *(place as *mut *mut u8).sub(1) = start };
            place as *mut u8
",
            ),
            (
                "unsafe { libc::free(ptr as *mut libc::c_void) }",
                "unsafe { libc::free(*ptr.cast::<*mut libc::c_void>().sub(1)) }",
            ),
        ],
    ),
    (
        "alloc/src/raw_vec/mod.rs",
        // Vectors of all types are made, grow and go in one place each, where no memory is the end; that crates have
        // functions of their own for it comes from the allocator, a parameter. Memory is aligned for every type there is, so
        // that a size is all that has to be said of one. A vector without memory is at an address that is an alignment.
        &[
            (
                "    fn try_allocate_in(\n        capacity",
                "    #[inline(always)]
    fn try_allocate_in(
        capacity: usize,
        init: AllocInit,
        alloc: A,
        elem_layout: Layout,
    ) -> Result<Self, TryReserveError> {
        let arguments = (capacity, matches!(init, AllocInit::Zeroed), size_of_one(elem_layout));
        let new = core::intrinsics::const_eval_select(arguments, never_new, fresh);
        Ok(Self { ptr: new.ptr, cap: new.cap, alloc })
    }

    fn unused_try_allocate_in(\n        capacity",
            ),
            (
                "    unsafe fn grow_amortized(",
                "    #[inline(always)]
    unsafe fn grow_amortized(
        &mut self,
        len: usize,
        additional: usize,
        elem_layout: Layout,
    ) -> Result<(), TryReserveError> {
        let arguments = (&raw mut *self as *mut RawVecInner, len + additional, size_of_one(elem_layout));
        core::intrinsics::const_eval_select(arguments, never_grows, grow);
        Ok(())
    }

    unsafe fn unused_grow_amortized(",
            ),
            (
                "        let cap = len.checked_add(additional).ok_or(CapacityOverflow)?;

        // SAFETY: preconditions passed to caller
        let ptr = unsafe { self.finish_grow(cap, elem_layout)? };

        // SAFETY: `finish_grow` would have failed if `cap > isize::MAX`
        unsafe { self.set_ptr_and_cap(ptr, cap) };
        Ok(())
",
                "        let vec = unsafe { &mut *(&raw mut *self as *mut RawVecInner) };
        let roomy = room(vec, len + additional, size_of_one(elem_layout));
        if roomy { Ok(()) } else { Err(CapacityOverflow.into()) }
",
            ),
            (
                "    unsafe fn deallocate(&mut self, elem_layout: Layout) {
        // SAFETY: Precondition passed to caller
        if let Some((ptr, layout)) = unsafe { self.current_memory(elem_layout) } {
            unsafe {
                self.alloc.deallocate(ptr, layout);
            }
        }
    }
",
                "    #[inline(always)]
    unsafe fn deallocate(&mut self, _: Layout) {
        release(self.ptr.as_ptr());
    }
",
            ),
            (
                "enum AllocInit {",
                "/// The alignment of all memory, and the highest that a type may have.
const ALIGNMENT: usize = 64;

/// Known where it is called: what it sees to takes no code.
pub(crate) const fn size_of_one(layout: Layout) -> usize {
    assert!(layout.align() <= ALIGNMENT);
    layout.size()
}

const fn never_new(_: usize, _: bool, _: usize) -> RawVecInner {
    panic!()
}

const fn never_grows(_: *mut RawVecInner, _: usize, _: usize) {
    panic!()
}

#[inline(never)]
fn fresh(capacity: usize, zeroed: bool, elem_size: usize) -> RawVecInner {
    let mut vec = RawVecInner::new_in(Global, unsafe { Alignment::new_unchecked(ALIGNMENT) });
    if capacity * elem_size != 0 {
        enlarge(&mut vec, capacity, elem_size);
        if zeroed {
            unsafe { ptr::write_bytes(vec.ptr.as_ptr(), 0, capacity * elem_size) };
        }
    }
    vec
}

#[inline(never)]
fn grow(vec: *mut RawVecInner, needed: usize, elem_size: usize) {
    let vec = unsafe { &mut *vec };
    enlarge(vec, cmp::max(cmp::max(vec.cap.as_inner() * 2, needed), 4), elem_size);
}

fn enlarge(vec: &mut RawVecInner, capacity: usize, elem_size: usize) {
    if !room(vec, capacity, elem_size) {
        core::intrinsics::abort();
    }
}

#[inline(never)]
pub(crate) fn release(place: *mut u8) {
    if place as usize > ALIGNMENT {
        unsafe { crate::alloc::dealloc(place, Layout::new::<u8>()) };
    }
}

#[inline(never)]
fn room(vec: &mut RawVecInner, capacity: usize, elem_size: usize) -> bool {
    let Some(size) = capacity.checked_mul(elem_size) else { return false };
    unsafe {
        let new = block(size);
        if new.is_null() {
            return false;
        }
        let old = vec.ptr.as_ptr();
        ptr::copy_nonoverlapping(old, new, vec.cap.as_inner() * elem_size);
        release(old);
        vec.ptr = Unique::new_unchecked(new);
        vec.cap = Cap::new_unchecked(capacity);
    }
    true
}

fn block(size: usize) -> *mut u8 {
    unsafe { crate::alloc::alloc(Layout::from_size_align_unchecked(size, ALIGNMENT)) }
}

#[inline(never)]
pub(crate) fn boxed(size: usize) -> *mut u8 {
    let new = block(size);
    if new.is_null() {
        core::intrinsics::abort();
    }
    new
}

#[inline(never)]
pub(crate) fn boxed_zeroed(size: usize) -> *mut u8 {
    let new = boxed(size);
    unsafe { ptr::write_bytes(new, 0, size) };
    new
}

enum AllocInit {",
            ),
        ],
    ),
    (
        "alloc/src/boxed.rs",
        // The same for boxes.
        &[
            (
                "            let layout = Layout::for_value_raw(ptr.as_ptr());
            if layout.size() != 0 {
                self.1.deallocate(From::from(ptr.cast()), layout);
            }
        }
    }
}

#[cfg(not(no_global_oom_handling))]
#[stable(feature = \"rust1\", since = \"1.0.0\")]
impl<T: Default> Default",
                "            crate::raw_vec::release(ptr.as_ptr().cast());
        }
    }
}

#[cfg(not(no_global_oom_handling))]
#[stable(feature = \"rust1\", since = \"1.0.0\")]
impl<T: Default> Default",
            ),
            (
                "    match Global.allocate(layout) {
        Ok(ptr) => ptr.as_mut_ptr(),
        Err(_) => handle_alloc_error(layout),
    }
}

/// Helper",
                "    match crate::raw_vec::size_of_one(layout) {
        0 => layout.dangling_ptr().as_ptr(),
        size => crate::raw_vec::boxed(size),
    }
}

/// Helper",
            ),
            (
                "#[inline]
// The is",
                "#[inline(always)]
// The is",
            ),
            (
                "        match Box::try_new_zeroed_in(alloc) {
            Ok(m) => m,
            Err(_) => handle_alloc_error(layout),
        }
    }

",
                "        let new = crate::raw_vec::boxed_zeroed(crate::raw_vec::size_of_one(layout));
        unsafe { Box::from_raw_in(new.cast(), alloc) }
    }

",
            ),
        ],
    ),
    (
        "alloc/src/sync.rs",
        &[
            // Nothing makes a `Weak`, so that memory goes with what is in it.
            (
                "        let _weak = Weak { ptr: self.ptr, alloc: &self.alloc };

        // Destroy the data at this time, even though we must not free the box
        // allocation itself (there might still be weak pointers lying around).
        // We cannot use `get_mut_unchecked` here, because `self.alloc` is borrowed.
        unsafe { ptr::drop_in_place(&mut (*self.ptr.as_ptr()).data) };
    }

    /// Returns `true` if the two",
                "        unsafe { ptr::drop_in_place(&mut (*self.ptr.as_ptr()).data) };
        unsafe { crate::alloc::dealloc(self.ptr.as_ptr().cast(), Layout::new::<u8>()) };
    }

    /// Returns `true` if the two",
            ),
            // No program makes 2^63 clones.
            (
                "        if old_size > MAX_REFCOUNT {
            abort();
        }

        unsafe { Self::from_inner_in(self.ptr, self.alloc.clone()) }",
                "        let _ = old_size;
        unsafe { Self::from_inner_in(self.ptr, self.alloc.clone()) }",
            ),
        ],
    ),
    (
        "core/src/slice/memchr.rs",
        // Texts are short.
        &[("    memchr_aligned(x, text)\n}", "    memchr_naive(x, text)\n}")],
    ),
    (
        "std/src/io/error/repr_bitpacked.rs",
        // No error is more than a number.
        &[("            let _ = decode_repr(self.0, |p| Box::<Custom>::from_raw(p));\n", "")],
    ),
    (
        "std/src/sys/pal/unix/futex.rs",
        // Who waits looks again why, so one signal may end it, and times are short: they need not be instants.
        &[
            (
                "        .and_then(|d| Timespec::now(libc::CLOCK_MONOTONIC).checked_add_duration(&d))
        .and_then(|t| t.to_timespec());
",
                "        .map(|d| libc::timespec { tv_sec: d.as_secs() as _, tv_nsec: d.subsec_nanos() as _ });\n",
            ),
            // The kernel looks first, too.
            (
                "        // No need to wait if the value already changed.
        if futex.load(Relaxed) != expected {
            return true;
        }
",
                "",
            ),
            ("libc::FUTEX_WAIT_BITSET | libc", "libc::FUTEX_WAIT | libc"),
            (
                "                        null::<u32>(), // This argument is unused for FUTEX_WAIT_BITSET.
                        !0u32,         // A full bitmask, to make it behave like a regular FUTEX_WAIT.
",
                "",
            ),
            (
                "        match (r < 0).then(crate::sys::io::errno) {
            Some(libc::ETIMEDOUT) => return false,
            Some(libc::EINTR) => continue,
            _ => return true,
        }
",
                "        return r == 0;\n",
            ),
        ],
    ),
    (
        "std/src/sys/pal/unix/time.rs",
        &[
            // The clock never goes back, and no span is as long as five centuries.
            (
                "Timespec) -> Result<Duration, Duration> {\n",
                "Timespec) -> Result<Duration, Duration> {
        let nanos = self.tv_nsec.as_inner() as i64 - other.tv_nsec.as_inner() as i64;
        return Ok(Duration::from_nanos(((self.tv_sec - other.tv_sec) * NSEC_PER_SEC as i64 + nanos) as u64));
",
            ),
            // There is such a clock.
            (
                "cvt(unsafe { libc::clock_gettime(clock, t.as_mut_ptr()) }).unwrap();",
                "unsafe { libc::syscall(libc::SYS_clock_gettime, clock, t.as_mut_ptr()) };",
            ),
            (
                "        let t = unsafe { t.assume_init() };
        Timespec::new(t.tv_sec as i64, t.tv_nsec as i64).unwrap()
",
                "        let t: libc::timespec = unsafe { t.assume_init() };
        unsafe { Timespec::new_unchecked(t.tv_sec as i64, t.tv_nsec as i64) }
",
            ),
        ],
    ),
    (
        "std/src/thread/thread.rs",
        &[
            // No thread has a name.
            (
                "        let name = name.map(ThreadNameString::from);\n",
                "        crate::mem::forget(name);\n        let name: Option<ThreadNameString> = None;\n",
            ),
            // No thread that has a handle ever ends.
            ("    inner: Pin<Arc<Inner, System>>,\n", "    inner: Pin<&'static Inner>,\n"),
            (
                "            let mut arc = Arc::<Inner, _>::new_uninit_in(System);
            let ptr = Arc::get_mut_unchecked(&mut arc).as_mut_ptr();
",
                "            let ptr = crate::boxed::Box::into_raw(crate::boxed::Box::<Inner>::new_uninit()).cast::<Inner>();\n",
            ),
            ("Pin::new_unchecked(arc.assume_init())", "Pin::new_unchecked(&*ptr)"),
            ("Arc::into_raw_with_allocator(inner).0 as *const ()", "inner as *const Inner as *const ()"),
            (
                "Pin::new_unchecked(Arc::from_raw_in(ptr as *const Inner, System))",
                "Pin::new_unchecked(&*(ptr as *const Inner))",
            ),
        ],
    ),
    (
        "std/src/thread/scoped.rs",
        // No thread starts others when it ends, and a panic in one ends all.
        &[
            ("main_thread: current_or_unnamed(),", "main_thread: super::current::current(),"),
            ("Ok(_) if scope.data.a_thread_panicked.load(Ordering::Relaxed) =>", "Ok(_) if false =>"),
            // Threads are few.
            ("Ordering::Relaxed) > usize::MAX / 2 {", "Ordering::Relaxed) > usize::MAX / 2 && false {"),
        ],
    ),
    (
        "std/src/thread/current.rs",
        &[
            // No thread asks for a number.
            ("        let id = id::get_or_init();\n", "        let id = unsafe { crate::mem::transmute(1u64) };\n"),
            // None ends that has a handle, and allocating asks for none.
            ("    if current == NONE {\n        CURRENT.set(BUSY);\n", "    if true {\n"),
            ("        crate::sys::thread_local::guard::enable();\n", ""),
        ],
    ),
    (
        "std/src/sys/pal/unix/mod.rs",
        &[
            // That signal can be ignored, and what ends the program ends it like a panic.
            ("rtassert!(signal(libc::SIGPIPE, handler) != libc::SIG_ERR);", "signal(libc::SIGPIPE, handler);"),
            ("    unsafe { libc::abort() }\n", "    core::intrinsics::abort()\n"),
            // A standard stream that is closed is an error where it is written to.
            ("    sanitize_standard_fds();\n", ""),
            // The page's size, which nobody asks for; arguments, which are there before.
            ("    stack_overflow::init();\n", ""),
            ("    crate::sys::args::init(argc, argv);\n", "    let _ = (argc, argv);\n"),
        ],
    ),
    (
        "std/src/rt.rs",
        &[
            // What is written to stdout is flushed at once, and only `main` ends the process.
            ("\n        cleanup();\n", ""),
            ("        crate::sys::exit::unique_thread_exit();\n", ""),
            // No message names a thread.
            ("    unsafe { main_thread::set(thread::current_id()) };\n", ""),
        ],
    ),
    (
        "std/src/sys/sync/mutex/futex.rs",
        &[
            // Calls, as locks are taken once per job.
            (
                "    #[inline]\n    // Make this a diagnostic item for Miri's concurrency model checker.
    #[cfg_attr(not(test), rustc_diagnostic_item = \"sys_mutex_lock\")]",
                "    #[inline(never)]",
            ),
            (
                "    #[inline]\n    // Make this a diagnostic item for Miri's concurrency model checker.
    #[cfg_attr(not(test), rustc_diagnostic_item = \"sys_mutex_unlock\")]",
                "    #[inline(never)]",
            ),
            // No lock is held for so short a time that one would spin.
            (
                "        let mut state = self.spin();\n",
                "        while self.futex.swap(CONTENDED, Acquire) != UNLOCKED {
            futex_wait(&self.futex, CONTENDED, None);
        }
        return;
        let mut state = self.spin();
",
            ),
        ],
    ),
    (
        "std/src/sys/sync/once/futex.rs",
        // What is made once is made: it does not fail.
        &[
            // Nobody lets go of what is being made.
            (
                "            _ => unreachable!(\"invalid Once state\"),\n",
                "            _ => OnceExclusiveState::Incomplete,\n",
            ),
            (
                "    #[cold]
    #[track_caller]
    pub fn call(",
                "    pub fn fresh_state() -> public::OnceState {
        public::OnceState { inner: OnceState { poisoned: false, set_state_to: Cell::new(COMPLETE) } }
    }

    #[inline(never)]
    pub fn begin(&self) -> bool {
        loop {
            match self.state_and_queued.compare_exchange(INCOMPLETE, RUNNING, Acquire, Acquire) {
                Ok(_) => return true,
                Err(COMPLETE) => return false,
                Err(_) => {}
            }
            _ = self.state_and_queued.compare_exchange(RUNNING, QUEUED, Relaxed, Relaxed);
            futex_wait(&self.state_and_queued, QUEUED, None);
        }
    }

    #[inline(never)]
    pub fn finish(&self) {
        if self.state_and_queued.swap(COMPLETE, Release) == QUEUED {
            futex_wake_all(&self.state_and_queued);
        }
    }

    #[cold]
    #[track_caller]
    pub fn call(",
            ),
        ],
    ),
    (
        "std/src/sync/once.rs",
        // By the functions above, which take no closure.
        &[(
            "        let mut f = Some(f);
        self.inner.call(true, &mut |p| f.take().unwrap()(p));
",
            "        if self.inner.begin() {
            f(&sys::Once::fresh_state());
            self.inner.finish();
        }
",
        )],
    ),
    (
        "core/src/panicking.rs",
        // Of an index. `unwrap`, `split_at`, copies between lengths that differ and all other checks stay.
        &[(
            "fn panic_bounds_check(index: usize, len: usize) -> ! {
    if cfg!(panic = \"immediate-abort\") {
        super::intrinsics::abort()
    }
",
            "fn panic_bounds_check(index: usize, len: usize) -> ! {
    unsafe { super::intrinsics::unreachable() }
",
        )],
    ),
    (
        "core/src/slice/index.rs",
        // Of a range.
        &[(
            "fn slice_index_fail(start: usize, end: usize, len: usize) -> ! {
",
            "fn slice_index_fail(start: usize, end: usize, len: usize) -> ! {
    unsafe { crate::intrinsics::unreachable() }
",
        )],
    ),
];
