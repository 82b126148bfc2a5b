//! Shares the threads for background work between long tasks, and the frames where there are none.
//!
//! In browsers tasks run on the thread that draws, as soon as the frame's systems are done: a task that only let others
//! go on would hold up the picture until it is done. So tasks wait for the next frame there, and all of them together
//! have a share of each.

use std::{
    future::poll_fn,
    sync::{Mutex, MutexGuard, PoisonError},
    task::{Context, Poll, Waker},
    time::Duration,
};

use bevy::{
    app::{App, First},
    ecs::system::Res,
    tasks::futures_lite::future::yield_now,
};
use web_time::Instant;

use super::budget::CoatingBudget;
use crate::rest::Rest;

/// Time after which a task lets others go on where there are threads for background work. Most are done before.
const TURN: Duration = Duration::from_millis(50);

/// Whether background work runs on the thread that draws.
const ONE_THREAD: bool = cfg!(target_arch = "wasm32");

/// Share of the frames of this process, where one thread does everything.
static FRAMES: FrameShare = FrameShare::new();

/// Turn of a task on its thread.
pub(crate) struct Turn {
    /// Time at which it began or went on; `None` while it waits.
    began: Option<Instant>,
    /// Frames that it has to share; `None` where there are threads for background work.
    share: Option<&'static FrameShare>,
}

impl Turn {
    /// Begins a turn, in a frame that has time for it.
    pub async fn begin() -> Self {
        Self::begin_in(ONE_THREAD.then_some(&FRAMES)).await
    }

    async fn begin_in(share: Option<&'static FrameShare>) -> Self {
        if let Some(share) = share {
            share.wait(false).await;
        }
        Self { began: Some(Instant::now()), share }
    }

    /// Ends the time that the turn has taken, and returns it.
    fn stop(&mut self) -> Duration {
        self.began.take().map_or(Duration::ZERO, |began| began.elapsed())
    }
}

impl Rest for Turn {
    /// Lets other tasks go on, or the frame, if the turn is over. A task that nobody wants any more ends here.
    async fn rest(&mut self) {
        match self.share {
            None if self.began.is_some_and(|began| began.elapsed() < TURN) => return,
            None => yield_now().await,
            Some(share) => {
                let taken = self.stop();
                if !share.spend(taken) {
                    share.wait(true).await;
                }
            }
        }
        self.began = Some(Instant::now());
    }
}

impl Drop for Turn {
    fn drop(&mut self) {
        let taken = self.stop();
        if let Some(share) = self.share {
            share.spend(taken);
        }
    }
}

/// Share of the frames that background work may take.
struct FrameShare(Mutex<Frame>);

/// Frame that is shared.
struct Frame {
    number: u64,
    /// Time that is left.
    left: Duration,
    /// Whether nothing has been done in it: something always is, however little time there is.
    untouched: bool,
    /// Tasks that wait, and whether they have done something in this frame.
    waiting: Vec<(bool, Waker)>,
}

impl FrameShare {
    const fn new() -> Self {
        Self(Mutex::new(Frame { number: 0, left: Duration::ZERO, untouched: true, waiting: Vec::new() }))
    }

    fn frame(&self) -> MutexGuard<'_, Frame> {
        self.0.lock().unwrap_or_else(PoisonError::into_inner)
    }

    /// Begins a frame with so much time, and wakes all tasks; first those that have done nothing in the last one.
    fn begin_frame(&self, time: Duration) {
        let mut frame = self.frame();
        frame.number = frame.number.wrapping_add(1);
        (frame.left, frame.untouched) = (time, true);
        let mut waiting = std::mem::take(&mut frame.waiting);
        drop(frame);
        waiting.sort_by_key(|&(ran, _)| ran);
        waiting.into_iter().for_each(|(_, task)| task.wake());
    }

    /// Takes time off the frame. Returns whether some is left.
    fn spend(&self, taken: Duration) -> bool {
        let mut frame = self.frame();
        frame.left = frame.left.saturating_sub(taken);
        !frame.left.is_zero()
    }

    /// Waits for time in this frame or, if the task `ran` in it, in a later one.
    async fn wait(&self, ran: bool) {
        let after = ran.then(|| self.frame().number);
        poll_fn(|context| self.poll(context, after)).await;
    }

    fn poll(&self, context: &Context<'_>, after: Option<u64>) -> Poll<()> {
        let mut frame = self.frame();
        let ran = after == Some(frame.number);
        if !ran && (frame.untouched || !frame.left.is_zero()) {
            frame.untouched = false;
            return Poll::Ready(());
        }
        frame.waiting.push((ran, context.waker().clone()));
        Poll::Pending
    }
}

/// Begins the frames that background work shares, where it has no threads of its own.
pub(crate) fn add_frames(app: &mut App) {
    if ONE_THREAD {
        app.add_systems(First, |budget: Res<CoatingBudget>| FRAMES.begin_frame(budget.max_time));
    }
}

#[cfg(test)]
mod tests {
    use std::{collections::VecDeque, pin::Pin, sync::Arc, task::Wake, thread::sleep};

    use super::*;

    /// Numbers of the tasks that can go on.
    type Ready = Arc<Mutex<VecDeque<usize>>>;

    /// Wakes a task by its number.
    struct Bell(usize, Ready);

    impl Wake for Bell {
        fn wake(self: Arc<Self>) {
            self.1.lock().expect("a queue").push_back(self.0);
        }
    }

    /// Three tasks of three pieces each, on the one thread of a browser.
    struct Page {
        frames: &'static FrameShare,
        tasks: Vec<Option<Pin<Box<dyn Future<Output = ()>>>>>,
        ready: Ready,
        /// Tasks that did the pieces, in their order.
        done: Arc<Mutex<Vec<usize>>>,
    }

    impl Page {
        fn new(piece: Duration) -> Self {
            let (frames, done): (&FrameShare, Arc<Mutex<Vec<usize>>>) =
                (Box::leak(Box::new(FrameShare::new())), Arc::default());
            let task = |number: usize| {
                let done = done.clone();
                let task: Pin<Box<dyn Future<Output = ()>>> = Box::pin(async move {
                    let mut turn = Turn::begin_in(Some(frames)).await;
                    for i in 0..3 {
                        if i > 0 {
                            turn.rest().await;
                        }
                        sleep(piece);
                        done.lock().expect("a list").push(number);
                    }
                });
                Some(task)
            };
            let (tasks, ready) = ((0..3).map(task).collect(), Arc::new(Mutex::new((0..3).collect())));
            Self { frames, tasks, ready, done }
        }

        /// Runs what can run within a frame; a browser would do so before it draws. Returns which tasks did pieces.
        fn frame(&mut self, time: Duration) -> Vec<usize> {
            self.frames.begin_frame(time);
            while let Some(number) = {
                let mut ready = self.ready.lock().expect("a queue");
                ready.pop_front()
            } {
                let bell = Waker::from(Arc::new(Bell(number, self.ready.clone())));
                let task = self.tasks[number].as_mut();
                if task.is_some_and(|task| task.as_mut().poll(&mut Context::from_waker(&bell)).is_ready()) {
                    self.tasks[number] = None;
                }
            }
            std::mem::take(&mut *self.done.lock().expect("a list"))
        }
    }

    #[test]
    fn one_thread_leaves_each_frame_in_time_and_serves_all_tasks_in_turn() {
        let piece = Duration::from_millis(2);
        // With no time at all something is done, too.
        for time in [Duration::ZERO, piece / 2] {
            let mut page = Page::new(piece);
            let frames: Vec<Vec<usize>> = (0..9).map(|_| page.frame(time)).collect();
            assert_eq!(frames.concat(), [0, 1, 2, 0, 1, 2, 0, 1, 2], "{time:?}");
            assert!(frames.iter().all(|done| done.len() == 1), "{frames:?}");
            assert!(page.frame(time).is_empty() && page.tasks.iter().all(Option::is_none));
        }
        let mut page = Page::new(Duration::ZERO);
        assert_eq!(page.frame(Duration::MAX), [0, 0, 0, 1, 1, 1, 2, 2, 2], "there is time for everything");
    }

    #[test]
    fn tasks_that_are_dropped_leave_the_others_their_time() {
        let piece = Duration::from_millis(2);
        let mut page = Page::new(piece);
        assert_eq!(page.frame(Duration::ZERO), [0]);
        (page.tasks[0], page.tasks[2]) = (None, None);
        let rest: Vec<usize> = (0..5).flat_map(|_| page.frame(Duration::ZERO)).collect();
        assert_eq!(rest, [1, 1, 1]);
    }
}
