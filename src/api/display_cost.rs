//! Measures the time of a frame that goes into showing films, which shares the budget with their steps.

use std::time::Duration;

use bevy::ecs::resource::Resource;
use web_time::Instant;

use super::budget::CoatingBudget;

/// Weight of the last frame in running means.
const NEWEST: f64 = 0.2;

/// Measured cost of showing films.
#[derive(Resource, Debug, Default)]
pub(crate) struct DisplayCost {
    /// Running mean of the seconds for one unit of work; 0 before the first measurement.
    per_unit: f64,
    /// Running mean of the time that a frame took.
    mean: Duration,
    /// Units of work in this frame.
    work: u64,
    /// Time spent in this frame.
    spent: Duration,
}

impl DisplayCost {
    /// Runs `show` and counts its time.
    pub fn measure<T>(&mut self, show: impl FnOnce() -> T) -> T {
        let begin = Instant::now();
        let shown = show();
        self.spent += begin.elapsed();
        shown
    }

    /// Closes the last frame and begins another.
    pub fn begin_frame(&mut self) {
        let weigh = |known: f64, now: f64| if known > 0.0 { known + NEWEST * (now - known) } else { now };
        if self.work > 0 {
            self.per_unit = weigh(self.per_unit, self.spent.as_secs_f64() / self.work as f64);
        }
        self.mean = Duration::from_secs_f64(weigh(self.mean.as_secs_f64(), self.spent.as_secs_f64()));
        (self.work, self.spent) = (0, Duration::ZERO);
    }

    /// Adds units of work that are done in this frame.
    pub fn count(&mut self, work: u64) {
        self.work += work;
    }

    /// Returns the expected time of so many units of work, in seconds.
    pub fn seconds(&self, work: u64) -> f64 {
        work as f64 * self.per_unit
    }

    /// Returns the time of a frame within which films are shown: half of the budget.
    pub fn share_of(budget: CoatingBudget) -> Duration {
        budget.max_time / 2
    }

    /// Returns the budget without the time that showing films takes, but no less than half of it. With a fixed cost of
    /// steps, which must not depend on the machine, nothing is taken off.
    pub fn leaves(&self, budget: CoatingBudget) -> CoatingBudget {
        if budget.fixed_cost.is_some() {
            return budget;
        }
        let max_time = budget.max_time.saturating_sub(self.mean.min(Self::share_of(budget)));
        CoatingBudget { max_time, ..budget }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn steps_get_what_display_leaves_but_no_less_than_half() {
        let budget = CoatingBudget::default();
        let after = |spent: u64| {
            let mut cost = DisplayCost { work: 1000, spent: Duration::from_micros(spent), ..DisplayCost::default() };
            cost.begin_frame();
            cost
        };
        assert_eq!(DisplayCost::default().leaves(budget), budget);
        assert_eq!(after(1500).leaves(budget).max_time, Duration::from_micros(2500));
        assert_eq!(after(9000).leaves(budget).max_time, Duration::from_millis(2));
        assert_eq!(after(9000).leaves(CoatingBudget::UNLIMITED).max_steps, u32::MAX);
        let fixed = CoatingBudget { fixed_cost: Some(Duration::from_micros(10)), ..budget };
        assert_eq!(after(9000).leaves(fixed), fixed, "replays do not depend on the machine");
        assert!((after(1500).seconds(2000) - 0.003).abs() < 1e-9);
    }
}
