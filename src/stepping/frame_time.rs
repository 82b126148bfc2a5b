//! Decides how much age a frame is worth and in how many rounds of steps it passes.

use crate::api::film_pace::FilmPace;

/// Backlog of a film, in frames' worth of steps, at which no age is given out until it has caught up. From half of it
/// on less and less is given.
const MOST_FRAMES_BEHIND: f64 = 4.0;

/// Returns the part of `age` that a frame can be worth: no film takes more than `max_steps` steps, and those that were
/// postponed can catch up. It is one age for all films, so their speeds keep their ratio.
///
/// Films that wait for rays to be cast do not slow the others down: nobody knows how long they will wait.
pub(super) fn shorten_age<'a>(age: f64, max_steps: u64, films: impl Iterator<Item = &'a FilmPace>) -> f64 {
    let max_steps = max_steps as f64;
    let (mut most, mut behind) = (age, 0.0_f64);
    for pace in films {
        most = most.min(pace.account.most_age(max_steps));
        if !pace.held {
            behind = behind.max(pace.account.backlog());
        }
    }
    let frames_behind = behind / max_steps;
    most * (2.0 - 2.0 * frames_behind / MOST_FRAMES_BEHIND).clamp(0.0, 1.0)
}

/// Time within one frame, which passes in rounds of at most one step a film.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct FrameTime {
    /// Rounds that have begun.
    round: u64,
    /// Rounds that there may be.
    rounds: u64,
    /// Rounds in which the time of the frame passes. Those that follow are for films that have waited, and for
    /// requested steps.
    passing: u64,
}

impl FrameTime {
    /// Plans the rounds of a frame in which `films` take at most `max_steps` steps each.
    pub fn new<'a>(films: impl Iterator<Item = &'a FilmPace>, max_steps: u64) -> Self {
        let mut time = Self { round: 0, rounds: 0, passing: 0 };
        for pace in films.filter(|pace| !pace.held && !pace.postponed) {
            time.rounds = time.rounds.max(pace.account.due(1.0).min(max_steps));
            if !pace.account.is_behind() {
                time.passing = time.passing.max(pace.account.due_to_clock(1.0));
            }
        }
        time
    }

    /// Begins the next round; returns false if there is none.
    pub fn begin_round(&mut self) -> bool {
        let goes_on = self.round < self.rounds;
        self.round += u64::from(goes_on);
        goes_on
    }

    /// Returns whether any round has begun.
    pub fn has_run(&self) -> bool {
        self.round > 0
    }

    /// Returns the time at the end of the round that is under way: 0 at the beginning of the frame, 1 at its end.
    pub fn now(&self) -> f64 {
        if self.round < self.passing { self.round as f64 / self.passing as f64 } else { 1.0 }
    }
}

#[cfg(test)]
mod tests {
    use std::sync::Arc;

    use rand::{Rng, RngExt, SeedableRng};
    use rand_chacha::ChaCha8Rng;

    use super::*;
    use crate::settings::CoatingSettings;

    /// Films of these speeds, in steps per unit of age, none of which has taken a step.
    struct Films {
        paces: Vec<FilmPace>,
        steps: Vec<u64>,
    }

    impl Films {
        fn new(speeds: &[f64]) -> Self {
            let settings = Arc::new(CoatingSettings::default());
            let pace = |&rate: &f64| FilmPace { rate, ..FilmPace::new(settings.clone()) };
            Self { paces: speeds.iter().map(pace).collect(), steps: vec![0; speeds.len()] }
        }

        /// Takes a frame's steps as the plugin does, in `most_rounds` rounds at most. Returns the age that passed.
        fn advance(&mut self, age: f64, max_steps: u64, most_rounds: u64, postponed: impl Fn(usize) -> bool) -> f64 {
            for pace in &mut self.paces {
                pace.account.begin(pace.rate, u64::MAX, age > 0.0, !pace.paused);
            }
            let age = shorten_age(age, max_steps, self.paces.iter());
            for (i, pace) in self.paces.iter_mut().enumerate() {
                pace.account.give(age);
                pace.postponed = postponed(i);
            }
            let mut time = FrameTime::new(self.paces.iter(), max_steps);
            let mut rounds = 0;
            while rounds < most_rounds && time.begin_round() {
                rounds += 1;
                for (pace, steps) in self.paces.iter_mut().zip(&mut self.steps) {
                    *steps += u64::from(!pace.postponed && pace.account.take(time.now()));
                }
            }
            for pace in &mut self.paces {
                assert!(pace.account.taken() <= max_steps);
                pace.account.end(time.now());
            }
            age * time.now()
        }

        fn request(&mut self, steps: u64) {
            for pace in &mut self.paces {
                pace.account.begin(0.0, u64::MAX, false, !pace.paused);
                pace.account.request(steps);
            }
        }
    }

    fn random_speeds(rng: &mut impl Rng) -> Vec<f64> {
        // Rates from 0.01 to 100 at 1,000 steps an age.
        let count = rng.random_range(2..6);
        (0..count).map(|_| 1000.0 * 10f64.powf(rng.random_range(-2.0..2.0))).collect()
    }

    #[test]
    fn over_any_second_films_keep_the_ratio_of_their_speeds() {
        for seed in 0..300 {
            let mut rng = ChaCha8Rng::seed_from_u64(seed);
            let speeds = random_speeds(&mut rng);
            let mut films = Films::new(&speeds);
            let max_steps = [1, 2, 3, 7, 16, 1000][rng.random_range(0..6)];
            let age_per_second = 10f64.powf(rng.random_range(-3.0..3.0));
            let (mut seconds, mut windows) = (0.0, Vec::new());
            let mut passed = 0.0;
            for _ in 0..400 {
                windows.push((seconds, passed, films.steps.clone()));
                let frame = rng.random_range(0.001..0.25);
                // Now and then the processor has something else to do, and a frame ends after its first round.
                let most_rounds = if rng.random_bool(0.3) { rng.random_range(1..4) } else { u64::MAX };
                passed += films.advance(age_per_second * frame, max_steps, most_rounds, |_| false);
                seconds += frame;
                let first = windows.partition_point(|(begin, ..)| seconds - begin > 1.0);
                for (_, before, steps) in &windows[first..] {
                    for (i, speed) in speeds.iter().enumerate() {
                        let taken = (films.steps[i] - steps[i]) as f64;
                        let due = (passed - before) * speed;
                        assert!((taken - due).abs() < 1.001, "seed {seed}: film {i} took {taken} steps of {due}");
                    }
                }
            }
            assert!(passed <= 400.0 * 0.25 * age_per_second);
        }
    }

    #[test]
    fn frames_that_have_time_pass_the_whole_age() {
        let mut films = Films::new(&[1000.0, 50.0]);
        let passed: f64 = (0..600).map(|_| films.advance(0.01, 16, u64::MAX, |_| false)).sum();
        assert!((passed - 6.0).abs() < 1e-9, "{passed}");
        assert!((5999..=6000).contains(&films.steps[0]) && (299..=300).contains(&films.steps[1]), "{:?}", films.steps);
    }

    #[test]
    fn the_fastest_film_takes_all_the_steps_that_it_may() {
        let mut films = Films::new(&[2000.0, 1000.0, 50.0]);
        for _ in 0..600 {
            films.advance(2.0 / 60.0, 16, u64::MAX, |_| false);
        }
        assert_eq!(films.steps, [9600, 4800, 240]);
    }

    #[test]
    fn postponed_films_catch_up_and_slow_all_alike_where_they_cannot() {
        for (speed, slows) in [(60.0, false), (900.0, true)] {
            let mut films = Films::new(&[speed, speed, 0.5 * speed]);
            // The second and the third film have their turns only every twelfth frame.
            let passed: f64 =
                (0..1200).map(|i| films.advance(1.0 / 60.0, 16, u64::MAX, |film| film > 0 && i % 12 > 0)).sum();
            assert_eq!(passed < 19.0, slows, "{passed}");
            for (steps, speed) in films.steps.iter().zip([speed, speed, 0.5 * speed]) {
                let behind = passed * speed - *steps as f64;
                assert!(behind > -1.0 && behind < 65.0, "{behind} at {speed}");
            }
        }
    }

    #[test]
    fn requested_steps_come_on_top_of_those_of_the_clock() {
        let mut films = Films::new(&[1000.0, 50.0]);
        films.request(10_000);
        let passed: f64 = (0..1800).map(|_| films.advance(2.0 / 60.0, 16, u64::MAX, |_| false)).sum();
        let of_clock = [passed * 1000.0, passed * 50.0];
        for (steps, of_clock) in films.steps.iter().zip(of_clock) {
            assert!((*steps as f64 - 10_000.0 - of_clock).abs() <= 1.0, "{steps} of {of_clock} and 10000");
        }
        assert!(passed > 10.0, "time goes on beside them: {passed}");
    }

    #[test]
    fn a_pause_holds_back_what_is_owed_and_what_was_requested() {
        let mut films = Films::new(&[600.0, 600.0]);
        for _ in 0..5 {
            films.advance(0.01, 16, u64::MAX, |film| film == 1);
        }
        films.request(5);
        let steps = films.steps.clone();
        films.paces[0].paused = true;
        films.paces[1].paused = true;
        films.request(7);
        for _ in 0..10 {
            films.advance(0.01, 16, u64::MAX, |_| false);
        }
        assert_eq!(films.steps, steps, "both stand still");
        for pace in &mut films.paces {
            pace.paused = false;
        }
        for _ in 0..20 {
            films.advance(1e-12, 16, u64::MAX, |_| false);
        }
        assert_eq!(films.steps, [35, 35], "and take later what they were owed, but not what was requested meanwhile");
    }

    #[test]
    fn infinite_speed_keeps_the_ratio() {
        let mut films = Films::new(&[100.0, 10.0, 0.0]);
        for _ in 0..100 {
            films.advance(f64::INFINITY, 30, u64::MAX, |_| false);
        }
        assert_eq!(films.steps, [3000, 300, 0]);
        assert_eq!(Films::new(&[0.0]).advance(f64::INFINITY, 30, u64::MAX, |_| false), f64::INFINITY);
    }
}
