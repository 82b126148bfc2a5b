//! How it looks: from nearby, on a sign, steered by hand, and finer than it is simulated.

use bevy_coating::{appearance::Detail, heat::HeatMap, settings::CoatingSettings};

use crate::measure::{
    claim::Claim,
    exhibit::{Exhibit, Shape, paper},
    figure::{ANY, Figure, Look, Panel, View, around, at_least, at_most},
    painted,
    trends::PLATES,
};

pub const CLOSE: Figure = Figure {
    number: "Fig. 13",
    file: "fig13",
    title: "a close-up",
    paper: "Beside a photograph of an old object, cracks and curls of the simulated film look like those of real \
            paint.",
    here: "A plate with the default settings, which measure in metres, of 11,488 triangles, each drawn as 256; age \
           0.85, seen from 20 centimetres.",
    view: View::Close { distance: 0.2, yaw: 0.35, at: [0.05, 0.05] },
    columns: 1,
    width: 800,
    panels: || vec![Panel { level: 4, ..Panel::new(close(), 0.85) }],
    claims: || {
        let measures = close().measured(&[0.85])?;
        let m = &measures[0];
        let mm = |metres: Option<f64>| metres.map_or(f64::NAN, |metres| 1e3 * metres);
        Ok(vec![
            Claim::single(
                "lift of what has let go, 90th percentile by area, in mm",
                mm(m.lift_area_p90_m),
                [10.0, 45.0],
                1,
            ),
            Claim::single("mean distance between cracks, in mm", mm(m.crack_spacing), [60.0, 300.0], 0),
            Claim::single("strain, root mean square", m.strain_rms.unwrap_or(f64::NAN), at_most(0.025), 4),
        ])
    },
};

fn close() -> Exhibit {
    Exhibit::new("close", "", Shape::Plate(PLATES[1]), CoatingSettings::default())
}

pub const SIGN: Figure = Figure {
    number: "Fig. 14",
    file: "fig14",
    title: "a street sign",
    paper: "A weathered sign fits into a scene in which everything is old.",
    here: "The sign of the example `city_sign` with the default settings, fresh and at age 0.75. In its street it is \
           shown by `cargo run --example city_sign`.",
    view: View::Free { yaw: 0.0, pitch: 0.0 },
    columns: 2,
    width: 800,
    panels: || {
        let panel = |age: f64| Panel { level: 2, ..Panel::new(Exhibit { title: format!("age {age}"), ..sign() }, age) };
        [0.0, 0.75].map(panel).to_vec()
    },
    claims: || {
        let measures = sign().measured(&[0.75])?;
        let m = &measures[0];
        Ok(vec![
            Claim::single("share separated at age 0.75", m.separated.unwrap_or(f64::NAN), [0.4, 0.8], 2),
            Claim::single("mean distance between cracks, in mm", m.crack_spacing.map_or(f64::NAN, |s| 1e3 * s), ANY, 0),
            Claim::single("places from which rust runs", m.sources as f64, at_least(5.0), 0),
        ])
    },
};

fn sign() -> Exhibit {
    Exhibit::new("sign", "", Shape::Sign(12_000), CoatingSettings::default())
}

pub const STEERED: Figure = Figure {
    number: "Fig. 16",
    file: "fig16",
    title: "weathering that is directed",
    paper: "Adhesion and binding can be varied by hand, place by place; colouring by adhesion minus lifting force \
            shows where the film is likely to fracture.",
    here: "A plate of 6,000 triangles by the paper's rules. The adhesion is multiplied by 2 along an S and by 0.7 in \
           a corner: fresh, its heat map, and at age 0.95. Its noise is weaker than by default (deviation 0.4). \
           `cargo run --example paint_brush` does it with a brush.",
    view: View::Wall,
    columns: 3,
    width: 800,
    panels: || {
        let panel = |(age, title, look): (f64, &str, Look)| Panel {
            look,
            ..Panel::new(Exhibit { title: title.to_owned(), ..painted::plate(7) }, age)
        };
        [
            (0.0, "before", Look::Paint),
            (0.0, "heat map", Look::Heat(HeatMap::Adhesion)),
            (painted::AGE, "after", Look::Paint),
        ]
        .map(panel)
        .to_vec()
    },
    claims: || {
        let found = painted::steered()?;
        let [protected, plain, weakened] = found.shares;
        Ok(vec![
            Claim::new("share that has let go at age 0.95 where protected", protected, at_most(0.1), 2),
            Claim::new("where nothing was done", plain, at_least(0.6), 2),
            Claim::new("where weakened", weakened, at_least(0.9), 2),
            Claim::new("rank correlation of the heat map with the age of letting go", found.foretold, at_least(0.9), 2),
        ])
    },
};

pub const FINE: Figure = Figure {
    number: "Fig. 18",
    file: "fig18",
    title: "shown finer than it is simulated",
    paper: "A plate simulated with 3,012 triangles is drawn with 46,399; lines of both meshes lie over each other.",
    here: "A plate of 3,012 triangles at age 0.9 by the paper's rules: as it is, drawn at level 2 of `Detail`, and \
           the lines of both meshes, green and grey.",
    view: View::Wall,
    columns: 3,
    width: 1100,
    panels: || {
        let panel = |(title, level, look): (&str, u32, Look)| Panel {
            look,
            level,
            ..Panel::new(Exhibit::new("plate", title, Shape::Plate(PLATES[0]), paper()), 0.9)
        };
        [("coarse", 0, Look::Paint), ("fine", 2, Look::Paint), ("both", 2, Look::Wires)].map(panel).to_vec()
    },
    claims: || {
        let fine = Detail { level: 2, ..Detail::default() }.triangles(PLATES[0] as usize);
        Ok(vec![Claim::single(
            "triangles that are drawn (the paper: 46,399)",
            fine as f64,
            around(46_399.0, 2_500.0),
            0,
        )])
    },
};
