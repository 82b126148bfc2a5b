//! Shares the threads for background work between long tasks.

use std::time::Duration;

use bevy::tasks::futures_lite::future::yield_now;
use web_time::Instant;

/// Time after which a task lets others go on. Most are done before.
const TURN: Duration = Duration::from_millis(50);

/// Turn of a task on its thread.
pub(crate) struct Turn {
    began: Instant,
}

impl Turn {
    /// Begins a turn.
    pub fn begin() -> Self {
        Self { began: Instant::now() }
    }

    /// Lets other tasks go on if the turn is over. A task that nobody wants any more ends here.
    pub async fn rest(&mut self) {
        if self.began.elapsed() >= TURN {
            yield_now().await;
            self.began = Instant::now();
        }
    }
}
