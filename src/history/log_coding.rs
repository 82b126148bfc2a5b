//! Codes the log of a history: who was touched in what order before tells who is touched next.

use super::{
    conditions::Conditions,
    event::{Event, LogEntry},
    touch_coding::TouchCoding,
    touched::Touched,
};
use crate::{
    coding::{Coder, Damage, Differences, Odds},
    deform::{SolverQuality, code_quality},
    film::{FaceId, HalfEdgeId, VertexId},
    settings::CoatingSettings,
    stain::{Environment, Exposure},
    touch::{Effect, Site, Touch},
};

/// Most memory that the log of a recording may take, in bytes: 256 MiB. What is read may say anything.
pub const MOST_BYTES: usize = 256 << 20;

const DAMAGED_LOG: Damage = Damage("its log");
const DAMAGED_SETTINGS: Damage = Damage("its settings, which are out of their ranges,");

/// Touch to be filled.
const BLANK_TOUCH: Touch =
    Touch { site: Site { face: FaceId(0), shares: [0; 2] }, radius: 0.0, hardness: 0.0, effect: Effect::Strip };

/// Number of kinds of events.
const KINDS: usize = 10;

/// Codes `conditions`, of which the defaults are expected.
///
/// # Errors
/// [`Damage`] if settings are out of range.
pub fn code_conditions<C: Coder>(conditions: &mut Conditions, coder: &mut C) -> Result<(), Damage> {
    code_settings(&mut conditions.settings, &CoatingSettings::default(), &mut Odds::default(), coder)?;
    code_environment(&mut conditions.environment, &Environment::default(), &mut Default::default(), coder);
    Ok(())
}

/// Codes a log that begins at step `first` under `conditions`, of a film that began with so many vertices.
///
/// # Errors
/// [`Damage`] if it is none, or takes more memory than [`MOST_BYTES`].
pub fn code_log<C: Coder>(
    log: &mut Vec<LogEntry>,
    first: u64,
    conditions: &Conditions,
    vertices: usize,
    coder: &mut C,
) -> Result<(), Damage> {
    let count = coder.length(log.len(), MOST_BYTES / size_of::<LogEntry>(), DAMAGED_LOG.0)?;
    let mut coding = LogCoding::new(first, conditions, vertices);
    let mut bytes = 0;
    if C::READS {
        for _ in 0..count {
            let mut entry = LogEntry { step: 0, event: Event::Quality(SolverQuality::default()) };
            coding.code(&mut entry, (MOST_BYTES - bytes) / size_of::<f32>(), coder)?;
            bytes += entry.bytes();
            if bytes > MOST_BYTES {
                return Err(DAMAGED_LOG);
            }
            log.push(entry);
        }
    } else {
        for entry in log {
            coding.code(entry, MOST_BYTES, coder)?;
        }
    }
    Ok(())
}

/// What is expected of the next entry.
struct LogCoding {
    step: u64,
    steps: Differences,
    /// Odds of the kinds, a tree of four bits, by the kind before.
    kinds: [[Odds; 16]; KINDS],
    kind: usize,
    conditions: Conditions,
    changed: Odds,
    environments: [Differences; 13],
    vertices: usize,
    exposure: Exposure,
    exposures: Differences,
    /// Touched vertices, faces, edges; edges that were torn and faces that were cut out.
    touched: [Touched; 5],
    touches: TouchCoding,
}

impl LogCoding {
    fn new(step: u64, conditions: &Conditions, vertices: usize) -> Self {
        Self {
            step,
            steps: Differences::default(),
            kinds: Default::default(),
            kind: 0,
            conditions: conditions.clone(),
            changed: Odds::default(),
            environments: Default::default(),
            vertices,
            exposure: Exposure::default(),
            exposures: Differences::default(),
            touched: Default::default(),
            touches: TouchCoding::default(),
        }
    }

    /// Codes the next entry, with at most `most` floats.
    fn code<C: Coder>(&mut self, entry: &mut LogEntry, most: usize, coder: &mut C) -> Result<(), Damage> {
        let mut later = entry.step.wrapping_sub(self.step);
        coder.long(&mut self.steps, &mut later);
        entry.step = self.step.checked_add(later).ok_or(DAMAGED_LOG)?;
        self.step = entry.step;

        let kind = self.code_kind(kind_of(&entry.event), coder)?;
        if C::READS {
            entry.event = blank(kind);
        }
        let [vertices, faces, edges, torn, cut] = &mut self.touched;
        match &mut entry.event {
            Event::Settings(settings) => {
                code_settings(settings, &self.conditions.settings, &mut self.changed, coder)?;
                self.conditions.settings.clone_from(settings);
            }
            Event::Environment(environment) => {
                code_environment(environment, &self.conditions.environment, &mut self.environments, coder);
                self.conditions.environment = *environment;
            }
            Event::Quality(quality) => *quality = code_quality(*quality, coder)?,
            Event::Exposure(exposure) => {
                for (list, before) in
                    [(&mut exposure.rain, &self.exposure.rain), (&mut exposure.sun, &self.exposure.sun)]
                {
                    // What is said of others means nothing, and reading it would take long.
                    list.truncate(self.vertices);
                    let count = coder.length(list.len(), most.min(self.vertices), DAMAGED_LOG.0)?;
                    list.resize(count, 0.0);
                    for (i, share) in list.iter_mut().enumerate() {
                        coder.float(&mut self.exposures, share, before.get(i).copied().unwrap_or(1.0));
                    }
                }
                self.exposure.clone_from(exposure);
            }
            Event::TearEdge(HalfEdgeId(h)) => torn.code(h, None, coder),
            Event::StripFace(FaceId(f)) => cut.code(f, None, coder),
            Event::Adhesion(VertexId(v), force) => vertices.code(v, Some(force), coder),
            Event::Contraction(FaceId(f), force) => faces.code(f, Some(force), coder),
            Event::Binding(HalfEdgeId(h), force) => edges.code(h, Some(force), coder),
            Event::Touch(touch, stroke) => self.touches.code(touch, stroke, coder)?,
        }
        Ok(())
    }

    fn code_kind<C: Coder>(&mut self, kind: usize, coder: &mut C) -> Result<usize, Damage> {
        let odds = self.kinds.get_mut(self.kind).ok_or(DAMAGED_LOG)?;
        let mut node = 1;
        for i in (0..4).rev() {
            let odds = odds.get_mut(node).ok_or(DAMAGED_LOG)?;
            node = node << 1 | usize::from(coder.bit(odds, kind >> i & 1 != 0));
        }
        self.kind = node - 16;
        if self.kind < KINDS { Ok(self.kind) } else { Err(DAMAGED_LOG) }
    }
}

fn kind_of(event: &Event) -> usize {
    match event {
        Event::Settings(_) => 0,
        Event::Environment(_) => 1,
        Event::Quality(_) => 2,
        Event::Exposure(_) => 3,
        Event::TearEdge(_) => 4,
        Event::StripFace(_) => 5,
        Event::Adhesion(..) => 6,
        Event::Contraction(..) => 7,
        Event::Binding(..) => 8,
        Event::Touch(..) => 9,
    }
}

/// Returns an event of a kind, to be filled.
fn blank(kind: usize) -> Event {
    match kind {
        0 => Event::Settings(Box::default()),
        1 => Event::Environment(Environment::default()),
        2 => Event::Quality(SolverQuality::default()),
        3 => Event::Exposure(Exposure::default()),
        4 => Event::TearEdge(HalfEdgeId(0)),
        5 => Event::StripFace(FaceId(0)),
        6 => Event::Adhesion(VertexId(0), 0.0),
        7 => Event::Contraction(FaceId(0), 0.0),
        8 => Event::Binding(HalfEdgeId(0), 0.0),
        _ => Event::Touch(BLANK_TOUCH, 0),
    }
}

/// Codes settings: which differ from those before, and by what.
fn code_settings<C: Coder>(
    settings: &mut CoatingSettings,
    before: &CoatingSettings,
    changed: &mut Odds,
    coder: &mut C,
) -> Result<(), Damage> {
    // Whoever cannot read them again must not write them.
    settings.validate().map_err(|_| DAMAGED_SETTINGS)?;
    let mut values = Differences::default();
    for field in CoatingSettings::fields() {
        let (mut value, expected) = (field.get(settings), field.get(before));
        let is_changed = coder.bit(changed, value.to_bits() != expected.to_bits());
        if is_changed {
            coder.float(&mut values, &mut value, expected);
        } else {
            value = expected;
        }
        if C::READS {
            field.set(settings, value).map_err(|_| DAMAGED_SETTINGS)?;
        }
    }
    Ok(())
}

fn code_environment<C: Coder>(
    environment: &mut Environment,
    before: &Environment,
    lists: &mut [Differences; 13],
    coder: &mut C,
) {
    let Environment { gravity, wind, gusts, rain, sun } = environment;
    let values = [gravity, wind, rain, sun].into_iter().flat_map(|v| [&mut v.x, &mut v.y, &mut v.z]);
    let expected = [before.gravity, before.wind, before.rain, before.sun].into_iter().flat_map(|v| v.to_array());
    let (values, expected) = (values.chain([gusts]), expected.chain([before.gusts]));
    for ((value, expected), list) in values.zip(expected).zip(lists) {
        coder.float(list, value, expected);
    }
}
