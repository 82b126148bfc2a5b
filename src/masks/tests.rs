//! Masks give weights from 0 to 1 on any film, and what they do not touch keeps its bits.

use std::f32::consts::{PI, TAU};

use bevy_math::{Vec2, Vec3, Vec4, ops};
use proptest::prelude::*;

use super::{
    Channel, CoatingMask, Mask, MaskEffect, MaskError, MaskFactors, MaskGround, MaskImage, MaskImages, Span,
    TextureMask, UvSet, Wrap, apply_masks, read_masks,
};
use crate::{
    film::FilmMesh,
    remesh::{BuiltFilm, FilmTarget, build_film, sample},
    settings::CoatingSettings,
    sim::FilmState,
    stain::Environment,
    surface::Surface,
};

/// Box of 0.4 x 0.6 x 0.2 m with texture coordinates and colours.
fn cuboid() -> Surface {
    let half = Vec3::new(0.2, 0.3, 0.1);
    let corner = |i: u32| {
        half * Vec3::new(
            [-1.0, 1.0][i as usize & 1],
            [-1.0, 1.0][(i >> 1) as usize & 1],
            [-1.0, 1.0][(i >> 2) as usize & 1],
        )
    };
    let positions: Vec<Vec3> = (0..8).map(corner).collect();
    let quads = [[0, 2, 3, 1], [4, 5, 7, 6], [0, 1, 5, 4], [2, 6, 7, 3], [0, 4, 6, 2], [1, 3, 7, 5]];
    let triangles: Vec<[u32; 3]> = quads.iter().flat_map(|&[a, b, c, d]| [[a, b, c], [a, c, d]]).collect();
    let corners: Vec<Vec3> = triangles.iter().flatten().map(|&v| positions[v as usize] / half).collect();
    Surface {
        uvs: corners.iter().map(|c| Vec2::new(0.5 + 0.5 * c.x, 0.5 - 0.5 * c.y)).collect(),
        colors: corners.iter().map(|c| Vec4::new(0.5 + 0.5 * c.x, 0.25, 0.0, 1.0)).collect(),
        positions,
        triangles,
        ..Surface::default()
    }
}

struct Prop {
    surface: Surface,
    built: BuiltFilm,
    images: MaskImages,
    gravity: Vec3,
}

impl Prop {
    fn new(surface: Surface, triangles: u32) -> Self {
        let built = build_film(&surface, FilmTarget::Triangles(triangles), 7).unwrap();
        Self { surface, built, images: images(), gravity: Vec3::NEG_Y }
    }

    fn plate(triangles: u32) -> Self {
        let piece = sample::plate(triangles, 3).unwrap();
        Self { surface: piece.surface, built: piece.film, images: images(), gravity: Vec3::NEG_Y }
    }

    fn ground(&self) -> MaskGround<'_> {
        MaskGround { surface: &self.surface, built: &self.built, gravity: self.gravity, images: &self.images }
    }

    fn mesh(&self) -> FilmMesh {
        FilmMesh::new(self.built.positions.clone(), &self.built.triangles).unwrap()
    }

    fn weights(&self, mask: &Mask) -> Vec<f32> {
        mask.weights(&self.mesh(), &self.ground()).unwrap()
    }

    fn film(&self) -> FilmState {
        FilmState::new(&self.built, &CoatingSettings::default(), 5, 200).unwrap()
    }
}

/// A gradient from black on the left to white on the right, with noise of its own in the other channels.
fn images() -> MaskImages {
    let texels = (0..16u8).flat_map(|y| (0..16u8).map(move |x| [17 * x, 17 * y, x ^ y, 255])).collect();
    MaskImages::from([("gradient.png".into(), MaskImage::new(16, 16, texels).unwrap())])
}

fn digest(film: &FilmState) -> blake3::Hash {
    let mut hasher = blake3::Hasher::new();
    film.digest_into(&mut hasher);
    hasher.finalize()
}

fn any_mask() -> impl Strategy<Value = Mask> {
    let slope = |least: f32| (least..=1.0f32, least..=1.0f32).prop_filter("a slope", |(a, b)| a != b);
    let channel = prop_oneof![Just(Channel::Red), Just(Channel::Green), Just(Channel::Blue), Just(Channel::Alpha)];
    let wrap = prop_oneof![Just(Wrap::Repeat), Just(Wrap::Mirror), Just(Wrap::Clamp)];
    let leaf = prop_oneof![
        (0.0..=1.0f32).prop_map(Mask::Even),
        (channel.clone(), wrap).prop_map(|(channel, wrap)| Mask::Texture(TextureMask {
            channel,
            wrap,
            ..TextureMask::new("gradient.png")
        })),
        channel.prop_map(Mask::Color),
        (0.0001..0.2f32, 0.0..1.0f32).prop_map(|(reach, soft)| Mask::Edges { reach, soft, sharp: soft + 0.5 }),
        slope(0.0).prop_map(|(full, none)| Mask::Lower { full, none }),
        slope(-1.0).prop_map(|(full, none)| Mask::Under { full, none }),
        (any::<u64>(), 0.0001..10.0f32).prop_map(|(seed, wavelength)| Mask::noise(seed, wavelength)),
        any::<f32>().prop_map(|factor| Mask::custom(move |place, normal| factor * place.x / normal.x)),
    ];
    leaf.prop_recursive(3, 12, 3, move |inner| {
        prop_oneof![
            prop::collection::vec(inner.clone(), 0..3).prop_map(Mask::Multiply),
            prop::collection::vec(inner.clone(), 0..3).prop_map(Mask::Max),
            inner.clone().prop_map(Mask::invert),
            (inner, slope(0.0)).prop_map(|(mask, (black, white))| mask.levels(black, white)),
        ]
    })
}

proptest! {
    #![proptest_config(ProptestConfig { failure_persistence: None, ..ProptestConfig::with_cases(48) })]

    #[test]
    fn weights_are_finite_from_0_to_1_and_always_the_same(
        mask in any_mask(),
        triangles in 20u32..600,
        gravity in prop_oneof![Just(Vec3::ZERO), Just(Vec3::NEG_Y), Just(Vec3::new(1e-30, 3.0, f32::MAX))],
    ) {
        let mut prop = Prop::new(cuboid(), triangles);
        prop.gravity = gravity;
        let weights = prop.weights(&mask);
        prop_assert_eq!(weights.len(), prop.built.positions.len());
        prop_assert!(weights.iter().all(|weight| (0.0..=1.0).contains(weight)), "{:?}", weights);
        let again = prop.weights(&mask);
        prop_assert!(weights.iter().zip(&again).all(|(a, b)| a.to_bits() == b.to_bits()));
    }

    #[test]
    fn what_has_no_effect_keeps_every_bit(mask in any_mask()) {
        let prop = Prop::new(cuboid(), 200);
        let (mut film, fresh) = (prop.film(), prop.film());
        let same = MaskEffect { contraction: Span(1.0, 1.0), dust: Span(0.0, 0.0), ..MaskEffect::default() };
        apply_masks(&mut film, &[CoatingMask { mask, effect: same }], &prop.ground()).unwrap();
        prop_assert_eq!(digest(&film), digest(&fresh));
    }

    #[test]
    fn films_with_masks_age_soundly(mask in any_mask(), far in any::<[bool; 6]>()) {
        let prop = Prop::new(cuboid(), 300);
        let mut film = prop.film();
        let span = |i: usize, most: f32| if far[i] { Span(most, 0.0) } else { Span(0.0, most) };
        let effect = MaskEffect {
            adhesion: span(0, 100.0),
            binding: span(1, 100.0),
            contraction: span(2, 100.0),
            dust: span(3, 1.0),
            rust: span(4, 10.0),
            moisture: span(5, 1.0),
        };
        apply_masks(&mut film, &[CoatingMask { mask, effect }], &prop.ground()).unwrap();
        prop_assert_eq!(film.validate(), Ok(()));
        film.age_to(0.2, &CoatingSettings::default(), &Environment::default());
        prop_assert_eq!(film.validate(), Ok(()));
    }
}

#[test]
fn edges_weigh_the_same_on_fine_and_coarse_films() {
    let mask = Mask::edges(0.04);
    for triangles in [1500, 6000, 24_000] {
        let prop = Prop::new(cuboid(), triangles);
        let half = Vec3::new(0.2, 0.3, 0.1);
        let weights = prop.weights(&mask);
        let (mut near, mut far) = (Vec::new(), Vec::new());
        for (place, &weight) in prop.built.positions.iter().zip(&weights) {
            // Distances from the three pairs of sides: an edge lies on two of them.
            let mut sides = (half - place.abs()).to_array();
            sides.sort_by(f32::total_cmp);
            if sides[1] < 1e-4 && sides[2] > 0.05 {
                near.push(weight);
            } else if sides[1] > 0.041 {
                far.push(weight);
            }
        }
        assert!(near.len() > 20 && far.len() > 100, "{} and {}", near.len(), far.len());
        assert!(near.iter().all(|&weight| weight > 0.9), "{triangles}: {near:?}");
        assert!(far.iter().all(|&weight| weight < 0.01), "{triangles}: {far:?}");
    }
}

/// A ball of 32 by 16 facets, with smooth shading normals or with those of its facets.
fn ball(radius: f32, is_smooth: bool) -> Surface {
    let (around, down) = (32u32, 16u32);
    let point = |i: u32, j: u32| {
        let (turn, fall) = (TAU * i as f32 / around as f32, PI * j as f32 / down as f32);
        let [across, aside, along] = [ops::sin(fall), ops::sin(turn), ops::cos(turn)];
        radius * Vec3::new(across * along, ops::cos(fall), across * aside)
    };
    let place = |i: u32, j: u32| match j {
        0 => 0,
        _ if j == down => 1 + around * (down - 1),
        _ => 1 + around * (j - 1) + i % around,
    };
    let mut positions = vec![point(0, 0)];
    positions.extend((1..down).flat_map(|j| (0..around).map(move |i| point(i, j))));
    positions.push(point(0, down));
    let mut triangles = Vec::new();
    for (j, i) in (0..down).flat_map(|j| (0..around).map(move |i| (j, i))) {
        let [a, b, c, d] = [place(i, j), place(i + 1, j), place(i + 1, j + 1), place(i, j + 1)];
        triangles.extend([[a, b, c], [a, c, d]].into_iter().filter(|[x, y, z]| x != y && y != z && z != x));
    }
    let at = |v: u32| positions[v as usize];
    let normals = triangles.iter().flat_map(|&[a, b, c]| {
        let facet = (at(b) - at(a)).cross(at(c) - at(a));
        [a, b, c].map(|v| if is_smooth { at(v) } else { facet })
    });
    Surface { normals: normals.collect(), positions: positions.clone(), triangles, ..Surface::default() }
}

#[test]
fn facets_of_what_is_shaded_smooth_are_no_edges() {
    let mask = Mask::edges(0.02);
    let [smooth, faceted] = [true, false].map(|is_smooth| {
        let prop = Prop::new(ball(0.35, is_smooth), 4000);
        let weights = prop.weights(&mask);
        weights.iter().sum::<f32>() / weights.len() as f32
    });
    assert!(smooth < 0.003 && faceted > 15.0 * smooth, "{smooth} against {faceted}");
    // A tight curve counts as before, whether it is shaded smooth or not.
    let small = Prop::new(ball(0.02, true), 4000).weights(&mask);
    assert!(small.iter().sum::<f32>() / small.len() as f32 > 0.5);
}

#[test]
fn rims_of_sheets_are_edges_and_their_middle_is_not() {
    let prop = Prop::plate(3012);
    let weights = prop.weights(&Mask::edges(0.05));
    for (place, weight) in prop.built.positions.iter().zip(weights) {
        let inside = 0.5 - place.abs().truncate().max_element();
        assert!(if inside < 1e-5 { weight > 0.9 } else { inside < 0.05 || weight == 0.0 }, "{inside}: {weight}");
    }
}

#[test]
fn textures_and_colours_are_read_where_the_film_lies() {
    let prop = Prop::new(cuboid(), 2000);
    let weights = prop.weights(&Mask::Texture(TextureMask { wrap: Wrap::Clamp, ..TextureMask::new("gradient.png") }));
    let colours = prop.weights(&Mask::Color(Channel::Red));
    for ((place, weight), colour) in prop.built.positions.iter().zip(weights).zip(colours) {
        let across = 0.5 + 0.5 * place.x / 0.2;
        assert!((colour - across).abs() < 1e-3, "{place}: {colour}");
        // Texels have their values in their middles.
        let gradient = ((across * 16.0 - 0.5) / 15.0).clamp(0.0, 1.0);
        assert!((weight - gradient).abs() < 0.01, "{place}: {weight} for {gradient}");
    }
}

#[test]
fn images_wrap_as_they_are_told() {
    let image = MaskImage::new(2, 1, vec![[0; 4], [255; 4]]).unwrap();
    let at = |u: f32, wrap| image.sample(Vec2::new(u, 0.3), Channel::Green, wrap);
    for (u, repeat, mirror, clamp) in [
        (0.25, 0.0, 0.0, 0.0),
        (0.75, 1.0, 1.0, 1.0),
        (1.25, 0.0, 1.0, 1.0),
        (-0.25, 1.0, 0.0, 0.0),
        (0.0, 0.5, 0.0, 0.0),
    ] {
        assert_eq!(at(u, Wrap::Repeat), repeat, "{u}");
        assert_eq!(at(u, Wrap::Mirror), mirror, "{u}");
        assert_eq!(at(u, Wrap::Clamp), clamp, "{u}");
    }
    for far in [f32::NAN, f32::INFINITY, f32::MIN, f32::MAX, 1e-40, -1e-40] {
        for wrap in [Wrap::Repeat, Wrap::Mirror, Wrap::Clamp] {
            assert!((0.0..=1.0).contains(&at(far, wrap)), "{far}");
        }
    }
}

#[test]
fn noise_has_its_wavelength_and_spread_on_any_film() {
    let spread = |triangles| {
        let weights = Prop::plate(triangles).weights(&Mask::noise(3, 0.1));
        let mean = weights.iter().sum::<f32>() / weights.len() as f32;
        let square = weights.iter().map(|w| (w - mean) * (w - mean)).sum::<f32>() / weights.len() as f32;
        (mean, square.sqrt())
    };
    let (coarse, fine) = (spread(3012), spread(12_000));
    assert!((coarse.0 - fine.0).abs() < 0.02 && (coarse.1 - fine.1).abs() < 0.02, "{coarse:?} {fine:?}");
    assert!((0.35..0.65).contains(&fine.0) && (0.15..0.3).contains(&fine.1), "{fine:?}");
    let prop = Prop::plate(400);
    assert_ne!(prop.weights(&Mask::noise(3, 0.1)), prop.weights(&Mask::noise(4, 0.1)));
}

#[test]
fn weak_and_dirty_places_come_off_and_stain_first() {
    let prop = Prop::plate(1500);
    let mut film = prop.film();
    let effect = MaskEffect {
        adhesion: Span(1.0, 0.3),
        binding: Span(1.0, 0.5),
        contraction: Span(1.0, 1.2),
        dust: Span(0.0, 0.9),
        rust: Span(0.0, 0.5),
        moisture: Span(0.0, 1.0),
    };
    let masks = [CoatingMask { mask: Mask::Lower { full: 0.49, none: 0.51 }, effect }];
    apply_masks(&mut film, &masks, &prop.ground()).unwrap();
    assert!(film.stains.is_damp() && film.stains.budget.emitted > 0.2);
    film.age_to(0.3, &CoatingSettings::default(), &Environment::default());
    film.validate().unwrap();
    let off = |lower: bool| {
        let vertices = film.mesh.topology.all_vertices().filter(|&v| film.mesh.topology.original(v) == v);
        let half: Vec<_> =
            vertices.filter(|v| (film.mesh.geometry.rest_positions[v.index()].y < 0.0) == lower).collect();
        half.iter().filter(|&&v| !film.forces.is_attached(v)).count() as f32 / half.len() as f32
    };
    assert!(off(true) > 2.0 * off(false), "{} below, {} above", off(true), off(false));
}

#[test]
fn what_is_not_there_is_named_with_the_way_out() {
    let mut prop = Prop::new(cuboid(), 100);
    let refusal = |prop: &Prop, mask: Mask| {
        let error = mask.weights(&prop.mesh(), &prop.ground()).unwrap_err();
        let (mut film, fresh) = (prop.film(), prop.film());
        let effect = MaskEffect { adhesion: Span(0.0, 0.5), ..MaskEffect::default() };
        let first = CoatingMask { mask: Mask::Even(1.0), effect };
        assert_eq!(apply_masks(&mut film, &[first, CoatingMask { mask, effect }], &prop.ground()), Err(error.clone()));
        assert_eq!(digest(&film), digest(&fresh), "nothing is changed");
        error.to_string()
    };
    assert_eq!(
        refusal(&prop, Mask::texture("wear.png")),
        "a mask asks for the image `wear.png`, but there are only gradient.png"
    );
    let second = Mask::Texture(TextureMask { uv: UvSet::Second, ..TextureMask::new("gradient.png") });
    assert!(refusal(&prop, second).contains("second texture coordinates"));
    prop.surface.colors.clear();
    assert_eq!(refusal(&prop, Mask::Color(Channel::Red)), MaskError::NoColors.to_string());
    assert!(refusal(&prop, Mask::noise(1, -1.0)).contains("wavelength"));
    assert!(refusal(&prop, Mask::Lower { full: 0.5, none: 0.5 }).contains("Lower"));
    let mut film = prop.film();
    film.step(&CoatingSettings::default(), &Environment::default());
    let mask = CoatingMask { mask: Mask::Even(1.0), effect: MaskEffect::default() };
    assert_eq!(apply_masks(&mut film, &[mask], &prop.ground()), Err(MaskError::NotFresh { steps: 1 }));
    let other = Prop::new(cuboid(), 400);
    let factors = MaskFactors::of(&[], &other.mesh(), &other.ground()).unwrap();
    assert!(matches!(factors.apply(&mut prop.film()), Err(MaskError::OtherFilm { .. })));
}

#[test]
fn lists_of_masks_are_read_and_faults_have_a_place() {
    let text = r#"[
        (mask: Multiply([Edges(reach: 0.02), Invert(Under())]), effect: (adhesion: (1.0, 0.3))),
        (mask: Levels(mask: Noise(wavelength: 0.2), black: 0.4, white: 0.6), effect: (dust: (0.0, 0.5))),
        (mask: Texture((image: "wear.png", channel: Blue, uv: Second, wrap: Mirror)), effect: ()),
    ]"#;
    let masks = read_masks(text, "a").unwrap();
    assert_eq!(masks[0].mask, Mask::Multiply(vec![Mask::edges(0.02), Mask::under().invert()]));
    assert_eq!(masks[1].mask, Mask::noise(0, 0.2).levels(0.4, 0.6));
    let mut names = Vec::new();
    masks.iter().for_each(|mask| mask.mask.textures(&mut |texture| names.push(texture.image.as_str())));
    assert_eq!(names, ["wear.png"]);
    let text = ron::ser::to_string_pretty(&masks, Default::default()).unwrap();
    assert_eq!(read_masks(&text, "a").unwrap(), masks);
    for (text, part) in [
        (
            "[(mask: Even(2.0), effect: ())]",
            "a.masks.ron: mask 1: `weight` of the mask `Even` is 2, but its range is 0 to 1",
        ),
        ("[(mask: Even(1.0), effect: (glue: (1.0, 0.0)))]", "a.masks.ron:1:"),
        ("[(mask: Edges(raech: 1.0), effect: ())]", "a.masks.ron:1:"),
        ("[(mask: Custom(1), effect: ())]", "a.masks.ron:1:"),
        ("", "a.masks.ron:1:"),
    ] {
        let error = read_masks(text, "a.masks.ron").unwrap_err().to_string();
        assert!(error.starts_with(part), "{text}: {error}");
    }
}

#[test]
fn what_masks_scale_goes_on_following_settings() {
    let prop = Prop::plate(100);
    let mut film = prop.film();
    let effect = MaskEffect {
        adhesion: Span(1.0, 0.5),
        binding: Span(1.0, 2.0),
        contraction: Span(1.0, 3.0),
        ..MaskEffect::default()
    };
    apply_masks(&mut film, &[CoatingMask { mask: Mask::Even(1.0), effect }], &prop.ground()).unwrap();
    let mut settings = CoatingSettings::default();
    (settings.adhesion.mean, settings.adhesion.deviation) = (2.0, 0.0);
    (settings.tearing.binding, settings.tearing.weak_probability) = (4.0, 0.0);
    settings.tearing.contraction = 1.5;
    film.forces.follow_settings(&film.mesh, &settings);
    let (topology, forces) = (&film.mesh.topology, &film.forces);
    assert!(topology.all_vertices().all(|v| (forces.adhesion(v) - 1.0).abs() < 1e-6));
    assert!(topology.all_faces().all(|f| (forces.contraction(f) - 4.5).abs() < 1e-5));
    let bound = topology.all_edges().filter(|&h| topology.bound_twin(h).is_some());
    assert!(bound.into_iter().all(|h| (forces.binding(topology, h) - 8.0).abs() < 1e-5));
}
