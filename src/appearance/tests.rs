//! Checks that the appearance at rest is the prop, and that it follows the film later.

use bevy_math::{Vec2, Vec3};
use proptest::prelude::*;

use super::{face_slots::has_separated, *};
use crate::{
    film::{FaceId, HalfEdgeId},
    remesh::sample,
    settings::{CoatingSettings, Preset},
    sim::FilmState,
    stain::Environment,
    touch::{Effect, Site, Touch},
};

fn aged(age: f64) -> (FilmState, FilmAppearance, Surface) {
    let piece = sample::plate(600, 4).unwrap();
    let mut settings = CoatingSettings::from(Preset::Paper);
    settings.deform.sweeps_per_age = 2000.0;
    let mut film = FilmState::new(&piece.film, &settings, 4, 250).unwrap();
    let mut appearance = FilmAppearance::new(&piece.film, &piece.surface, &film.mesh, &film.forces, &film.stains);
    film.age_to(age, &settings, &Environment::default());
    appearance.update(&film.mesh, &film.forces, &film.stains, DisplayChanges::everything());
    (film, appearance, piece.surface)
}

fn triangles(part: &MeshPart) -> impl Iterator<Item = [usize; 3]> + '_ {
    part.triangles().map(|t| t.map(|i| i as usize))
}

fn at(values: &[[f32; 3]], i: usize) -> Vec3 {
    Vec3::from_array(values[i])
}

#[test]
fn a_fresh_film_is_the_prop_and_nothing_else() {
    let (film, appearance, surface) = aged(0.0);
    let front = appearance.front(0).unwrap();
    assert_eq!(appearance.slot_count(), 1);
    assert_eq!(front.indices.len(), 1800);
    assert_eq!(front.positions.len(), film.mesh.topology.vertex_count(), "one vertex each on a smooth plate");
    assert!([appearance.backs(0), appearance.metal(0)].iter().flatten().all(|part| part.is_empty()));
    assert_eq!([appearance.backs(1), appearance.metal(1)], [None; 2], "there is one slot");
    for (t, f) in triangles(front).zip(film.mesh.topology.all_faces()) {
        for (i, k) in t.into_iter().zip(0..3) {
            let corner = f.index() * 3 + k;
            assert_eq!(at(&front.positions, i), surface.positions[surface.triangles[f.index()][k] as usize]);
            assert!(at(&front.normals, i).abs_diff_eq(surface.normals[corner], 1e-6), "the prop's own");
            assert!(Vec2::from_array(front.uvs[i]).abs_diff_eq(surface.uvs[corner], 1e-6));
        }
    }
}

#[test]
fn backs_and_metal_show_where_film_separated_and_only_there() {
    let (film, appearance, _) = aged(0.8);
    let topology = &film.mesh.topology;
    let separated = topology.live_faces().filter(|&f| has_separated(topology, &film.forces, f)).count();
    let removed = topology.face_count() - topology.live_faces().count();
    assert!(separated > 100 && removed > 2, "{separated} {removed}");
    assert_eq!(triangles(appearance.front(0).unwrap()).count(), topology.live_faces().count());
    let (backs, metal) = (appearance.backs(0).unwrap(), appearance.metal(0).unwrap());
    assert_eq!(triangles(backs).count(), separated);
    assert_eq!(triangles(metal).count(), separated + removed);
    // The metal lies flat, just under the film at rest, facing out; backs face the other way than their fronts.
    let depth = film.mesh.geometry.mean_edge * METAL_DEPTH;
    assert!(metal.positions.iter().all(|p| (p[2] + depth).abs() < 1e-6));
    assert!(metal.normals.iter().all(|n| n[2] > 0.99999));
    for part in [metal, backs, appearance.front(0).unwrap()] {
        assert_eq!(part.positions.len(), part.normals.len());
        let mut agree = 0;
        for t in triangles(part) {
            let [a, b, c] = t.map(|i| at(&part.positions, i));
            agree += usize::from((b - a).cross(c - a).dot(at(&part.normals, t[0])) > 0.0);
        }
        assert!(agree > triangles(part).count() * 95 / 100, "winding agrees with normals: {agree}");
    }
}

#[test]
fn each_slot_has_backs_and_metal_of_its_own_with_its_coordinates() {
    let mut piece = sample::plate(600, 4).unwrap();
    // The right half of the plate is another primitive.
    let xs = || piece.film.positions.iter().map(|p| p.x);
    let middle = (xs().fold(f32::MAX, f32::min) + xs().fold(f32::MIN, f32::max)) / 2.0;
    let slot =
        |t: &[u32; 3]| u32::from(t.iter().map(|&v| piece.film.positions[v as usize].x).sum::<f32>() > 3.0 * middle);
    piece.film.slots = piece.film.triangles.iter().map(slot).collect();
    let settings = CoatingSettings::from(Preset::Paper);
    let mut film = FilmState::new(&piece.film, &settings, 4, 100).unwrap();
    film.age_to(0.8, &settings, &Environment::default());
    let appearance = FilmAppearance::new(&piece.film, &piece.surface, &film.mesh, &film.forces, &film.stains);
    let topology = &film.mesh.topology;
    let separated = |f: &FaceId| has_separated(topology, &film.forces, *f);
    for slot in 0..2u32 {
        let here = |f: &FaceId| piece.film.slots[f.index()] == slot;
        let backs = topology.live_faces().filter(here).filter(separated).count();
        let gone = topology.all_faces().filter(here).filter(|&f| !topology.is_live(f)).count();
        let part = |part: Option<&MeshPart>| part.unwrap().clone();
        let (back, metal) = (part(appearance.backs(slot as usize)), part(appearance.metal(slot as usize)));
        assert!(backs > 20, "slot {slot}");
        assert_eq!((back.indices.len(), metal.indices.len()), (backs * 3, (backs + gone) * 3), "slot {slot}");
        for part in [back, metal] {
            let count = part.positions.len();
            assert_eq!([part.normals.len(), part.uvs.len(), part.stains.len()], [count; 3], "slot {slot}");
            let edge = film.mesh.geometry.mean_edge;
            let inside = |p: &[f32; 3]| if slot == 1 { p[0] > middle - edge } else { p[0] < middle + edge };
            assert!(part.rest.iter().all(inside), "slot {slot} keeps to its side");
        }
    }
}

#[test]
fn front_vertices_part_where_the_film_tore_and_nowhere_else() {
    let (film, appearance, _) = aged(0.7);
    let (topology, front) = (&film.mesh.topology, appearance.front(0).unwrap());
    let mut edges = std::collections::BTreeMap::new();
    for t in triangles(front) {
        for k in 0..3 {
            *edges.entry((t[k], t[(k + 1) % 3])).or_insert(0) += 1;
        }
    }
    let shared = edges.iter().filter(|((a, b), _)| edges.contains_key(&(*b, *a))).count();
    let bound =
        topology.all_half_edges().filter(|&h| topology.is_live(h.face()) && topology.bound_twin(h).is_some()).count();
    assert_eq!(shared, bound, "watertight where nothing tore");
    assert!(edges.values().all(|&n| n == 1));
}

#[test]
fn normals_follow_the_film_as_it_bends() {
    let (film, appearance, _) = aged(0.8);
    let front = appearance.front(0).unwrap();
    let (mut close, mut turned) = (0, 0);
    let mut corners = 0;
    for t in triangles(front) {
        corners += 3;
        let [a, b, c] = t.map(|i| at(&front.positions, i));
        let face = (b - a).cross(c - a).normalize_or_zero();
        for i in t {
            let normal = at(&front.normals, i);
            assert!((normal.length() - 1.0).abs() < 1e-3);
            close += usize::from(normal.dot(face) > 0.6);
            turned += usize::from(normal.z < 0.95);
        }
    }
    assert!(close * 10 > corners * 9, "{close} of {corners}");
    assert!(turned > 50, "{turned}");
    assert!(film.measure().lift_p90 > Some(0.3));
}

/// Every part: fronts, backs and metal.
fn parts(appearance: &FilmAppearance) -> Vec<&MeshPart> {
    let slots = 0..appearance.slot_count();
    let fronts = slots.clone().filter_map(|slot| appearance.front(slot));
    let backs = slots.clone().filter_map(|slot| appearance.backs(slot));
    fronts.chain(backs).chain(slots.filter_map(|slot| appearance.metal(slot))).collect()
}

/// Bits of all attributes of each corner of each triangle of a part, in an order that does not depend on numbers.
pub(super) fn shown(part: &MeshPart) -> Vec<[Vec<u32>; 3]> {
    fn bits<const N: usize>(values: &[[f32; N]], i: u32) -> impl Iterator<Item = u32> {
        // Zeros have two signs.
        values.get(i as usize).into_iter().flatten().map(|x| (x + 0.0).to_bits())
    }
    let corner = |i: u32| {
        let places = bits(&part.positions, i).chain(bits(&part.normals, i)).chain(bits(&part.tangents, i));
        let own = bits(&part.uvs, i).chain(bits(&part.uvs_1, i)).chain(bits(&part.colors, i));
        let rest = bits(&part.rest, i).chain(bits(&part.rest_normals, i)).chain(bits(&part.stains, i));
        places.chain(own).chain(rest).collect()
    };
    let mut shown: Vec<_> = part.triangles().map(|t| t.map(corner)).collect();
    shown.sort_unstable();
    shown
}

/// Returns what every part shows.
fn arrays(appearance: &FilmAppearance) -> Vec<Vec<[Vec<u32>; 3]>> {
    parts(appearance).into_iter().map(shown).collect()
}

/// Brings a copy of a part up to date with nothing but its changes.
fn repeat(copy: &mut MeshPart, part: &MeshPart, changes: &PartChanges) {
    fn take<T: Copy + Default>(to: &mut Vec<T>, from: &[T], ranges: &IndexRanges) {
        to.resize(from.len(), T::default());
        let ranges = if from.is_empty() { &IndexRanges::default() } else { ranges };
        ranges.ranges().for_each(|range| to[range.clone()].copy_from_slice(&from[range]));
    }
    if changes.whole {
        copy.clone_from(part);
        return;
    }
    take(&mut copy.uvs, &part.uvs, &changes.renewed);
    take(&mut copy.uvs_1, &part.uvs_1, &changes.renewed);
    take(&mut copy.colors, &part.colors, &changes.renewed);
    take(&mut copy.rest, &part.rest, &changes.renewed);
    take(&mut copy.rest_normals, &part.rest_normals, &changes.renewed);
    take(&mut copy.positions, &part.positions, &changes.moved);
    take(&mut copy.normals, &part.normals, &changes.moved);
    take(&mut copy.tangents, &part.tangents, &changes.moved);
    take(&mut copy.stains, &part.stains, &changes.stained);
    take(&mut copy.indices, &part.indices, &changes.indices);
}

/// Changes of every part, in the order of [`parts`].
fn part_changes(appearance: &FilmAppearance) -> Vec<&PartChanges> {
    let slots = 0..appearance.slot_count();
    let fronts = slots.clone().filter_map(|slot| appearance.front_changes(slot));
    let backs = slots.clone().filter_map(|slot| appearance.back_changes(slot));
    fronts.chain(backs).chain(slots.filter_map(|slot| appearance.metal_changes(slot))).collect()
}

#[test]
fn what_new_paint_attached_again_is_shown_as_what_never_let_go() {
    for level in [0, 2] {
        let piece = sample::curved_plate(600, 3).unwrap();
        let mut settings = CoatingSettings::default();
        (settings.tearing.binding, settings.tearing.weak_factor) = (1e6, 1.0);
        let mut film = FilmState::new(&piece.film, &settings, 3, 120).unwrap();
        film.age_to(0.7, &settings, &Environment::default());
        film.changes.clear();
        let detail = Detail { level, ..Detail::default() };
        let make = |film: &FilmState| {
            let FilmState { mesh, forces, stains, .. } = film;
            FilmAppearance::with_detail(&piece.film, &piece.surface, mesh, forces, stains, detail).unwrap()
        };
        let mut appearance = make(&film);
        let mut changes = DisplayChanges::default();
        changes.record(&film.changes, &film.stains);
        changes.take();
        let (topology, geometry) = (&film.mesh.topology, &film.mesh.geometry);
        let middle = geometry.rest_positions.iter().sum::<Vec3>() / geometry.rest_positions.len() as f32;
        let from_middle = |f: &FaceId| geometry.rest_centroid(topology, *f).distance_squared(middle);
        let face = topology.all_faces().min_by(|a, b| from_middle(a).total_cmp(&from_middle(b))).unwrap();
        let touch = Touch::new(Site::new(face, Vec3::ONE), 0.25, Effect::Repaint);
        assert_eq!(film.touch(&touch, &settings, &Environment::default()), Ok(false), "in place");
        assert!(film.changes.attached.len() > 5);
        changes.record(&film.changes, &film.stains);
        appearance.update(&film.mesh, &film.forces, &film.stains, changes.take());
        let again = make(&film);
        // The same triangles, whatever their order.
        let shape = |part: &MeshPart| {
            let mut all: Vec<_> = triangles(part).map(|t| t.map(|i| part.positions[i].map(f32::to_bits))).collect();
            all.sort_unstable();
            all
        };
        for (part, again) in parts(&appearance).into_iter().zip(parts(&again)) {
            assert!(shape(part) == shape(again), "level {level}");
        }
    }
}

#[test]
fn changes_of_parts_tell_all_that_changed() {
    for level in [0, 2] {
        let mut piece = sample::curved_plate(400, 3).unwrap();
        piece.film.slots = piece.film.triangles.iter().map(|t| t[0] % 2).collect();
        let mut settings = CoatingSettings::default();
        settings.scale.grain = 0.06;
        let mut film = FilmState::new(&piece.film, &settings, 3, 120).unwrap();
        let detail = Detail { level, ..Detail::default() };
        let FilmState { mesh, forces, stains, .. } = &film;
        let mut appearance =
            FilmAppearance::with_detail(&piece.film, &piece.surface, mesh, forces, stains, detail).unwrap();
        let mut copies: Vec<MeshPart> = parts(&appearance).into_iter().cloned().collect();
        let (mut changes, mut gone, mut written) = (DisplayChanges::default(), false, 0);
        for step in 0..140 {
            film.step(&settings, &Environment::default());
            changes.record(&film.changes, &film.stains);
            gone |= !film.changes.removed.is_empty();
            if step % 3 == 1 {
                continue;
            }
            appearance.update(&film.mesh, &film.forces, &film.stains, changes.take());
            let all = parts(&appearance).into_iter().zip(part_changes(&appearance));
            for (copy, (part, changes)) in copies.iter_mut().zip(all) {
                assert!(!changes.whole, "only the first time");
                written += usize::from(!changes.indices.is_empty());
                repeat(copy, part, changes);
                assert_eq!(copy.indices, part.indices, "level {level}, step {step}");
                assert_eq!(shown(copy), shown(part), "level {level}, step {step}");
            }
        }
        assert!(gone && written > 50, "{written}");
    }
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(12))]

    /// However a film is torn, stripped and stepped, what is shown is what a new appearance shows.
    #[test]
    fn edits_are_shown_as_a_new_appearance_shows_them(
        edits in prop::collection::vec((0..3u8, any::<prop::sample::Index>()), 1..40),
        level in 0..=2u32,
    ) {
        let piece = sample::curved_plate(160, 5).unwrap();
        let settings = CoatingSettings::from(Preset::Paper);
        let environment = Environment::default();
        let mut film = FilmState::new(&piece.film, &settings, 5, 60).unwrap();
        let detail = Detail { level, ..Detail::default() };
        let fresh = |film: &FilmState| {
            let FilmState { mesh, forces, stains, .. } = film;
            FilmAppearance::with_detail(&piece.film, &piece.surface, mesh, forces, stains, detail).unwrap()
        };
        let (mut followed, mut changes) = (fresh(&film), DisplayChanges::default());
        for (kind, at) in edits {
            let topology = &film.mesh.topology;
            match kind {
                0 => {
                    let edge = HalfEdgeId::new(at.index(topology.half_edge_count()));
                    film.tear_edge(edge, &settings, &environment);
                }
                1 => {
                    let face = FaceId::new(at.index(topology.face_count()));
                    film.strip_face(face, &settings, &environment);
                }
                _ => film.step(&settings, &environment),
            }
            changes.record(&film.changes, &film.stains);
            // Not at every edit, so that several are seen at once.
            if at.index(3) > 0 {
                followed.update(&film.mesh, &film.forces, &film.stains, changes.take());
                prop_assert_eq!(arrays(&followed), arrays(&fresh(&film)));
            }
        }
    }
}

#[test]
fn what_nothing_happened_to_is_not_written() {
    let piece = sample::plate(3000, 3).unwrap();
    let settings = CoatingSettings::from(Preset::Paper);
    let mut film = FilmState::new(&piece.film, &settings, 3, 500).unwrap();
    let mut appearance = FilmAppearance::new(&piece.film, &piece.surface, &film.mesh, &film.forces, &film.stains);
    let (mut changes, mut tears, mut written) = (DisplayChanges::default(), 0, 0);
    for _ in 0..200 {
        film.step(&settings, &Environment::default());
        changes.record(&film.changes, &film.stains);
        tears += film.changes.torn.len();
        appearance.update(&film.mesh, &film.forces, &film.stains, changes.take());
        let front = appearance.front_changes(0).unwrap();
        written += front.indices.ranges().map(|range| range.len() / 3).sum::<usize>();
    }
    assert!(tears > 10, "{tears}");
    assert!(written < 8 * tears, "{written} triangles for {tears} tears");
    appearance.update(&film.mesh, &film.forces, &film.stains, DisplayChanges::everything());
    assert!(part_changes(&appearance).into_iter().all(PartChanges::is_empty), "everything was seen already");
}

#[test]
fn paint_is_shown_within_its_tolerance_and_for_less() {
    let piece = sample::plate(600, 3).unwrap();
    let mut settings = CoatingSettings::default();
    settings.scale.grain = 0.06;
    for level in [0, 2] {
        let mut film = FilmState::new(&piece.film, &settings, 3, 1000).unwrap();
        film.age_to(0.5, &settings, &Environment::default());
        let show = |film: &FilmState, tolerance: f32| {
            let FilmState { mesh, forces, stains, .. } = film;
            let detail = Detail { level, tolerance, ..Detail::default() };
            FilmAppearance::with_detail(&piece.film, &piece.surface, mesh, forces, stains, detail).unwrap()
        };
        let (mut exact, mut near) = (show(&film, 0.0), show(&film, 0.01));
        assert_eq!(arrays(&exact), arrays(&near), "it begins where the film is");
        let (mut changes, mut moved, mut apart) = (DisplayChanges::default(), [0, 0], 0.0f32);
        for _ in 0..60 {
            film.step(&settings, &Environment::default());
            changes.record(&film.changes, &film.stains);
            let taken = changes.take();
            for (shown, moved) in [&mut exact, &mut near].into_iter().zip(&mut moved) {
                shown.update(&film.mesh, &film.forces, &film.stains, taken);
                *moved += shown.front_changes(0).unwrap().moved.ranges().map(|range| range.len()).sum::<usize>();
            }
            let [a, b] = [&exact, &near].map(|shown| shown.seen.moves.positions());
            let gaps = a.iter().zip(b).map(|(a, b)| (*a - *b).abs().max_element());
            apart = gaps.fold(apart, f32::max);
        }
        let most = 0.01 * film.mesh.geometry.mean_edge;
        assert!(apart > 0.5 * most && apart <= most, "{apart} of {most}: moves add up, and no further");
        assert!(moved[1] * 3 < moved[0] * 2, "level {level}: {moved:?} vertices were written");
        changes.restart();
        near.update(&film.mesh, &film.forces, &film.stains, changes.take());
        assert_eq!(arrays(&near), arrays(&show(&film, 0.0)), "another epoch begins where the film is");
    }
}

#[test]
fn duplicates_are_stained_as_they_are_and_not_as_they_were() {
    let piece = sample::plate(200, 3).unwrap();
    let settings = CoatingSettings::default();
    let mut film = FilmState::new(&piece.film, &settings, 3, 100).unwrap();
    let detail = Detail { level: 2, ..Detail::default() };
    let show = |film: &FilmState| {
        let FilmState { mesh, forces, stains, .. } = film;
        FilmAppearance::with_detail(&piece.film, &piece.surface, mesh, forces, stains, detail).unwrap()
    };
    let mut followed = show(&film);
    let topology = &film.mesh.topology;
    let border = |v| topology.is_border(v);
    let edge = topology
        .all_edges()
        .find(|&h| topology.rest_twin(h).is_some() && border(topology.origin(h)) != border(topology.target(h)));
    film.tear_edge(edge.unwrap(), &settings, &Environment::default());
    let duplicate = film.mesh.topology.vertex_count() - 1;
    assert!(duplicate >= film.mesh.topology.original_vertex_count(), "a vertex was split");
    // Between two looks the new vertex got dust of its own.
    film.stains.film.dust[duplicate] = 0.7;
    followed.update(&film.mesh, &film.forces, &film.stains, DisplayChanges::everything());
    assert_eq!(arrays(&followed), arrays(&show(&film)));
}

#[test]
fn recorded_changes_bring_an_appearance_to_where_a_new_one_begins() {
    let piece = sample::plate(300, 1).unwrap();
    let settings = CoatingSettings::from(Preset::Paper);
    let mut film = FilmState::new(&piece.film, &settings, 1, 100).unwrap();
    let appearance =
        |film: &FilmState| FilmAppearance::new(&piece.film, &piece.surface, &film.mesh, &film.forces, &film.stains);
    let (mut followed, mut changes) = (appearance(&film), DisplayChanges::default());
    let (mut steps, mut topology, mut exposure, mut stains) = (0, 0, 0, 0);
    for _ in 0..100 {
        film.step(&settings, &Environment::default());
        changes.record(&film.changes, &film.stains);
        steps += 1;
        // Sometimes several steps pass between two looks.
        if steps % 3 == 1 {
            continue;
        }
        let taken = changes.take();
        followed.update(&film.mesh, &film.forces, &film.stains, taken);
        assert_eq!(arrays(&followed), arrays(&appearance(&film)), "after step {steps}");
        assert!(changes.is_empty());
        topology += usize::from(taken.topology);
        exposure += usize::from(taken.exposure);
        stains += usize::from(taken.stains);
    }
    assert!(topology > 5 && topology < 66 && exposure > 5 && stains > 5, "{topology} {exposure} {stains}");
}

#[test]
fn going_back_in_time_is_not_taken_for_standing_still() {
    let piece = sample::plate(300, 1).unwrap();
    let settings = CoatingSettings::from(Preset::Paper);
    let mut film = FilmState::new(&piece.film, &settings, 1, 100).unwrap();
    film.age_to(0.4, &settings, &Environment::default());
    let young = film.clone();
    film.age_to(1.0, &settings, &Environment::default());
    let appearance =
        |film: &FilmState| FilmAppearance::new(&piece.film, &piece.surface, &film.mesh, &film.forces, &film.stains);
    let (mut followed, mut changes) = (appearance(&film), DisplayChanges::default());
    assert_ne!(arrays(&followed), arrays(&appearance(&young)));
    changes.restart();
    followed.update(&young.mesh, &young.forces, &young.stains, changes.take());
    assert_eq!(arrays(&followed), arrays(&appearance(&young)));
    // A signal whose flags were lost still tells by its epoch.
    changes.restart();
    changes.take();
    followed.update(&film.mesh, &film.forces, &film.stains, changes);
    assert_eq!(arrays(&followed), arrays(&appearance(&film)));
}

#[test]
fn a_prop_without_normals_gets_smooth_ones_where_it_is_smooth() {
    let piece = sample::curved_plate(400, 2).unwrap();
    let surface = Surface { normals: Vec::new(), ..piece.surface };
    let film = FilmState::new(&piece.film, &CoatingSettings::from(Preset::Paper), 0, 100).unwrap();
    let appearance = FilmAppearance::new(&piece.film, &surface, &film.mesh, &film.forces, &film.stains);
    let front = appearance.front(0).unwrap();
    for (p, n) in front.positions.iter().zip(&front.normals) {
        let out = Vec3::new(p[0], 0.0, p[2]).normalize();
        assert!(Vec3::from_array(*n).dot(out) > 0.95);
    }
}

#[test]
fn flipped_faces_are_wound_as_the_prop_was() {
    let mut piece = sample::plate(100, 2).unwrap();
    piece.film.flipped = vec![true; 100];
    let film = FilmState::new(&piece.film, &CoatingSettings::from(Preset::Paper), 0, 100).unwrap();
    let appearance = FilmAppearance::new(&piece.film, &piece.surface, &film.mesh, &film.forces, &film.stains);
    let front = appearance.front(0).unwrap();
    for t in triangles(front) {
        let [a, b, c] = t.map(|i| at(&front.positions, i));
        assert!((b - a).cross(c - a).z < 0.0);
    }
}
