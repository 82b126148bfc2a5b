//! Loads the settings file again when it has changed on the disk.

use bevy::ecs::system::{Local, ResMut};
use web_time::{Duration, Instant};

use super::{seen::Seen, state::CoatingPanel};

/// Time between two looks at the file.
const PAUSE: Duration = Duration::from_millis(400);

/// Looks at the file from time to time while it is followed, and asks for it to be loaded when it has changed.
pub(super) fn follow_file(mut panel: ResMut<CoatingPanel>, mut last: Local<Option<Instant>>) {
    if !panel.follows_file {
        return;
    }
    let now = Instant::now();
    if last.is_some_and(|last| now.duration_since(last) < PAUSE) {
        return;
    }
    *last = Some(now);
    // A file that is just being replaced may be missing for a moment.
    let Some(seen) = Seen::look(&panel.file) else { return };
    let has_changed = panel.seen.as_ref().is_some_and(|before| seen.is_later_than(before));
    panel.file_has_changed |= has_changed;
    panel.seen = Some(seen);
}
