//! Stains: rust below a lone crack, and dust.

use crate::measure::{
    claim::Claim,
    exhibit::{Exhibit, Shape},
    figure::{Figure, Look, Panel, View, around, at_least, at_most},
    stains::{self, DUST_AGE, Factor},
};

pub const RUN_OFF: Figure = Figure {
    number: "Figs. 9 and 10",
    file: "fig09",
    title: "rust from a lone crack",
    paper: "Of a crack only the lower end is a source of rust, also when it grows or branches; the rust runs down \
            along the surface, in the direction of gravity projected on it.",
    here: "A plate of 3,012 triangles that tears once, and does nothing more by itself; default rust, ages 0.1, 0.4 \
           and 1. A line is drawn along the crack, and a mark at its source. The numbers are at age 1.",
    view: View::Wall,
    columns: 3,
    width: 800,
    panels: || {
        let panel = |age: f64| Panel {
            look: Look::Cracks,
            ..Panel::new(Exhibit { title: format!("age {age}"), ..stains::cracked_plate(7) }, age)
        };
        [0.1, 0.4, 1.0].map(panel).to_vec()
    },
    claims: || {
        let found = stains::run_off()?;
        Ok(vec![
            Claim::new("sources at the crack: its lower end", found.sources, around(1.0, 0.0), 0),
            Claim::new(
                "share of plates whose source goes on with the crack downward, and stays when it goes on upward",
                found.moves,
                around(1.0, 0.0),
                2,
            ),
            Claim::new("share of the rust that is at or below the lower end", found.below, at_least(0.99), 3),
            Claim::new("rust above the upper end over rust below the lower one", found.above, at_most(0.0), 3),
            Claim::new("rust 20 to 30 cm below the source over that 0 to 10 cm below", found.fading, [0.3, 0.8], 2),
            Claim::new("deviation of the rust from a plumb line, in metres", found.width, [0.01, 0.08], 3),
        ])
    },
};

pub const DUST: Figure = Figure {
    number: "Fig. 11",
    file: "fig11",
    title: "black stains by each factor",
    paper: "Dust gathers more slowly where a place is higher, faces down more, or is more convex. Each factor is \
            shown by itself, and then all three.",
    here: "The vase with sound paint at age 0.7: one factor with all its weight in each of the first three, the \
           default weights in the last. The numbers compare the tenth of the vertices where a factor wants most dust \
           with the tenth where it wants least.",
    view: View::Free { yaw: 0.3, pitch: 0.3 },
    columns: 4,
    width: 800,
    panels: || {
        let titles = ["height", "direction", "curvature", "all three"];
        let panel = |(factor, title): (Factor, &str)| {
            Panel::new(Exhibit::new("dust", title, Shape::Vase(6_000), factor.settings()), DUST_AGE)
        };
        Factor::EVERY.into_iter().zip(titles).map(panel).collect()
    },
    claims: || {
        let [height, direction, curvature] = stains::dust()?;
        Ok(vec![
            Claim::new("dust at the foot over dust at the top, by height alone", height, at_least(2.0), 1),
            Claim::new("dust on what faces up over what faces down, by direction alone", direction, at_least(2.0), 1),
            Claim::new("dust in hollows over dust on ridges, by curvature alone", curvature, at_least(1.1), 2),
        ])
    },
};
