//! Cracks: few and many, on three models, on coarse and fine plates, by alpha and beta.

use bevy_coating::settings::CoatingSettings;

use crate::measure::{
    claim::Claim,
    exhibit::{Exhibit, NoFilm, Shape, paper},
    figure::{ANY, Figure, Look, Panel, View, around, at_least, at_most},
    spread::{Spread, over_seeds},
    trends::{self, ALPHAS, BETAS, HIGH_ALPHA, PLATES, by_grain},
};

/// Settings that crack only near what peels, as the method before the paper's did.
fn few_cracks() -> CoatingSettings {
    let mut settings = paper();
    let tearing = &mut settings.tearing;
    (tearing.beta, tearing.binding_decay) = (0.9, 5.0);
    (tearing.weak_probability, tearing.contraction_kept) = (0.004, 0.7);
    settings
}

fn unbent(mut settings: CoatingSettings) -> CoatingSettings {
    settings.deform.sweeps_per_age = 0.0;
    settings
}

const FEW_AGE: f64 = 0.9;

pub const FEW: Figure = Figure {
    number: "Fig. 12",
    file: "fig12",
    title: "few cracks, long cracks, and bending",
    paper: "The method before this one has cracks only beside what has peeled. The static simulation alone makes \
            long cracks that branch; bending adds curls that open them. With other parameters few cracks can still \
            be had.",
    here: "A plate of 3,012 triangles at age 0.9: few cracks (beta 0.9, decay of binding 5, 0.4 % weak edges, 0.7 of \
           the contraction kept at a tear) and the paper's constants, both without bending and with lines along the \
           cracks; and the same with bending.",
    view: View::Wall,
    columns: 3,
    width: 800,
    panels: || {
        let panel = |(title, settings, look): (&str, CoatingSettings, Look)| Panel {
            look,
            level: 1,
            ..Panel::new(Exhibit::new("plate", title, Shape::Plate(3_012), settings), FEW_AGE)
        };
        let all = [
            ("few cracks, static", unbent(few_cracks()), Look::Cracks),
            ("static only", unbent(paper()), Look::Cracks),
            ("with bending", paper(), Look::Paint),
        ];
        all.map(panel).to_vec()
    },
    claims: || {
        let plate = |settings, seed| {
            Exhibit { seed, ..Exhibit::new("plate", "", Shape::Plate(3_012), settings) }.measured(&[FEW_AGE])
        };
        let [few, tips, many, lift] = over_seeds(|seed| {
            let (few, many) = (plate(unbent(few_cracks()), seed)?, plate(paper(), seed)?);
            let of = |m: Option<f64>| m.unwrap_or_default();
            let (few, many) = (&few[0], &many[0]);
            Ok([
                of(few.crack_length) / of(many.crack_length),
                of(few.stripped) + of(few.fallen),
                of(many.crack_length),
                of(many.lift_p90),
            ])
        })?;
        let flat = Exhibit::new("plate", "", Shape::Plate(3_012), unbent(paper())).measured(&[FEW_AGE])?;
        Ok(vec![
            Claim::new("length of few cracks over that of the paper's constants", few, at_most(0.6), 2),
            Claim::new("share of the paint that is gone with few cracks", tips, ANY, 3),
            Claim::new("length of cracks with the paper's constants, in sides of the plate", many, ANY, 1),
            Claim::new("lift of what has let go with bending, 90th percentile, in edges", lift, [0.8, 2.8], 2),
            Claim::single("the same lift without bending", flat[0].lift_p90.unwrap_or(f64::NAN), around(0.0, 0.0), 2),
        ])
    },
};

pub const MODELS: Figure = Figure {
    number: "Fig. 15 and Table 1",
    file: "fig15",
    title: "a plate, a curved plate and a closed model",
    paper: "Three kinds of model weather alike: a flat plate of 3,012 triangles, a curved one of 3,005 and the \
            Stanford bunny of 10,000. 1,000 steps take 15 to 66 seconds.",
    here: "The same plates, and a fire hydrant remeshed to 10,000 triangles (the bunny's licence keeps it out of \
           this repository); the paper's rules, age 0.9, without stains in the picture.",
    view: View::Free { yaw: -0.35, pitch: 0.12 },
    columns: 3,
    width: 800,
    panels: || {
        let all = [
            ("flat plate", Shape::Plate(3_012)),
            ("curved plate", Shape::CurvedPlate(3_005)),
            ("closed model", Shape::Hydrant(10_000)),
        ];
        let panel =
            |(title, shape)| Panel { level: 1, ..Panel::new(Exhibit::new("model", title, shape, paper()), 0.9) };
        all.map(panel).to_vec()
    },
    claims: || {
        let mut claims = Vec::new();
        for (name, shape) in [("curved plate", Shape::CurvedPlate(3_005)), ("hydrant", Shape::Hydrant(10_000))] {
            let measures = Exhibit::new("model", "", shape, unbent(paper())).measured(&[1.0])?;
            let of = |share: Option<f64>| share.unwrap_or_default();
            claims.push(Claim::single(
                format!("share separated at age 1, {name}"),
                of(measures[0].separated),
                [0.6, 0.95],
                2,
            ));
            claims.push(Claim::single(
                format!("share of edges torn at age 1, {name}"),
                of(measures[0].torn),
                [0.05, 0.3],
                2,
            ));
        }
        Ok(claims)
    },
};

pub const FINENESS: Figure = Figure {
    number: "Fig. 17",
    file: "fig17",
    title: "coarse and fine plates",
    paper: "Counted in triangles, 11,488 of them crack much more densely than 3,012 on the same plate; a higher \
            alpha brings the fine plate back to about as many cracks.",
    here: "The same three plates by the paper's rules at age 0.6, with alpha 0.9 in the third; then 3,012 and 11,488 \
           triangles by the default rules, which measure in metres and need no other alpha.",
    view: View::Wall,
    columns: 5,
    width: 800,
    panels: || {
        let [coarse, fine] = PLATES;
        let mut straight = paper();
        straight.tearing.alpha = HIGH_ALPHA;
        let all = [
            ("3,012, the paper's rules", coarse, paper()),
            ("11,488, the paper's rules", fine, paper()),
            ("11,488, alpha 0.9", fine, straight),
            ("3,012, in metres", coarse, by_grain()),
            ("11,488, in metres", fine, by_grain()),
        ];
        let panel = |(title, triangles, settings)| {
            Panel::new(Exhibit::new("plate", title, Shape::Plate(triangles), settings), 0.9)
        };
        all.map(panel).to_vec()
    },
    claims: || {
        let [coarse, fine] = [trends::cracks_by_alpha(PLATES[0])?, trends::cracks_by_alpha(PLATES[1])?];
        let at = |rows: &[[Spread; 2]], alpha: f32| {
            let index = ALPHAS.iter().position(|known| *known == alpha).unwrap_or_default();
            rows[index][1]
        };
        let [c, f, straight] = [at(&coarse, 0.45), at(&fine, 0.45), at(&fine, HIGH_ALPHA)];
        let [grain_coarse, grain_fine] = trends::cracks_by_grain()?;
        Ok(vec![
            Claim::new("length of cracks at age 0.6, in sides of the plate: 3,012", c, ANY, 1),
            Claim::new("11,488", f, ANY, 1),
            Claim::new("11,488, alpha 0.9", straight, ANY, 1),
            Claim::new("3,012, in metres", grain_coarse, ANY, 1),
            Claim::new("11,488, in metres", grain_fine, ANY, 1),
            Claim::single("fine over coarse by the paper's rules", f.mean / c.mean, around(2.5, 0.5), 2),
            Claim::single("the same with alpha 0.9", straight.mean / c.mean, around(1.0, 0.3), 2),
            Claim::single("fine over coarse in metres", grain_fine.mean / grain_coarse.mean, around(1.0, 0.25), 2),
        ])
    },
};

pub const CONTROL: Figure = Figure {
    number: "Section 5.2",
    file: "alpha_beta",
    title: "alpha and beta",
    paper: "An edge ahead of a crack tears more easily, if the cosine of its direction is above alpha (0.45) and its \
            binding times beta (0.2) is less than the contraction of its faces: cracks get straight.",
    here: "Plates by the paper's rules over five seeds, for alpha at age 0.6 and for beta at age 1. A higher alpha \
           makes straighter and fewer cracks. Beta is a threshold: where it is above the contraction of two faces (2 \
           when fresh, 4 at age 1) over the binding (6), cracks do not run on.",
    view: View::Wall,
    columns: 0,
    width: 800,
    panels: Vec::new,
    claims: control,
};

fn control() -> Result<Vec<Claim>, NoFilm> {
    let mut claims = Vec::new();
    for triangles in PLATES {
        let rows = trends::cracks_by_alpha(triangles)?;
        let plate = format!("{},{:03} triangles", triangles / 1000, triangles % 1000);
        for (alpha, [straightness, length]) in ALPHAS.iter().zip(&rows) {
            claims.push(Claim::new(format!("straightness, {plate}, alpha {alpha}"), *straightness, ANY, 3));
            claims.push(Claim::new(format!("length in sides, {plate}, alpha {alpha}"), *length, ANY, 1));
        }
        let ([first, .., last], [_, .., before, _]) = (&rows[..], &rows[..]) else { continue };
        let gained = before[0].mean - first[0].mean;
        claims.push(Claim::single(
            format!("straightness gained from alpha -0.5 to 0.9, {plate}"),
            gained,
            at_least(0.1),
            3,
        ));
        let shorter = last[1].mean / first[1].mean;
        claims.push(Claim::single(
            format!("length at alpha 0.95 over that at -0.5, {plate}"),
            shorter,
            at_most(0.4),
            2,
        ));
        let falls = rows.windows(2).filter(|pair| pair[1][1].mean < pair[0][1].mean).count();
        let all = ALPHAS.len() - 1;
        claims.push(Claim::single(
            format!("steps of alpha on which cracks get shorter, of {all}, {plate}"),
            falls as f64,
            around(all as f64, 0.0),
            0,
        ));
    }
    let torn = trends::torn_by_beta()?;
    for (beta, torn) in BETAS.iter().zip(&torn) {
        claims.push(Claim::new(format!("share of edges torn at age 1, beta {beta}"), *torn, ANY, 3));
    }
    let at = |beta: f32| BETAS.iter().zip(&torn).find(|(known, _)| **known == beta).map_or(f64::NAN, |(_, t)| t.mean);
    claims.push(Claim::single(
        "torn at beta 0.3 over torn at 0.1: below the threshold",
        at(0.3) / at(0.1),
        around(1.0, 0.1),
        2,
    ));
    claims.push(Claim::single("torn at beta 0.7 over torn at 0.3: above it", at(0.7) / at(0.3), at_most(0.2), 2));
    Ok(claims)
}

/// Shares that an independent prototype had on plates of 3,012 triangles, with the margins of its seeds: age, which
/// share, and band.
const SHARES: [(usize, usize, [f64; 2]); 6] = [
    (0, 0, around(0.13, 0.06)),
    (1, 0, around(0.27, 0.06)),
    (3, 0, around(0.75, 0.06)),
    (2, 1, [0.04 / 1.5, 0.04 * 4.0 / 3.0]),
    (3, 1, around(0.17, 0.17 / 3.0)),
    (3, 2, [0.005, 0.05]),
];

pub const AGES: Figure = Figure {
    number: "Sections 5.1 to 5.3",
    file: "ages",
    title: "shares at each age",
    paper: "Paint separates, tears and is stripped, and the stages go on side by side. The paper gives no numbers.",
    here: "A plate of 3,012 triangles by the paper's rules, over five seeds; loose pieces stay. Bands are those of \
           an independent prototype.",
    view: View::Wall,
    columns: 0,
    width: 800,
    panels: Vec::new,
    claims: || {
        let shares = trends::shares_by_age()?;
        let mut claims = Vec::new();
        for (index, (age, row)) in trends::AGES.iter().zip(&shares).enumerate() {
            for (which, name) in ["vertices separated", "edges torn", "faces stripped"].iter().enumerate() {
                let band = SHARES.iter().find(|(i, w, _)| (*i, *w) == (index, which)).map_or(ANY, |(.., band)| *band);
                claims.push(Claim::new(format!("share of {name} at age {age}"), row[which], band, 3));
            }
        }
        Ok(claims)
    },
};
