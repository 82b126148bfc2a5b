//! Arranges triangles in a tree of boxes, to find quickly whether a ray meets any of them.

use std::ops::Range;

use bevy_math::Vec3;

use super::ray::Ray;
use crate::rest::{LIGHT_PIECE, NoRest, Rest, at_once};

/// Largest number of triangles in a leaf.
const LEAF: usize = 4;
/// Size of the stack of a walk through the tree. Every node splits its triangles into halves, so 32 levels would do for
/// 2^32 triangles.
const DEPTH: usize = 64;

/// Number of triangles that are sorted in a piece of the work, each time that one is.
const SORTED: usize = 4 * LIGHT_PIECE;

/// Triangles in a tree of boxes, which finds quickly whether a ray meets any of them.
///
/// ```
/// use bevy_coating::stain::exposure::TriangleTree;
/// use bevy_math::Vec3;
///
/// let broken = [Vec3::NAN, Vec3::X, Vec3::Y];
/// let tree = TriangleTree::new([[Vec3::ZERO, Vec3::X, Vec3::Y], broken]);
/// assert_eq!(tree.len(), 1, "triangles that are not finite are left out");
/// assert_eq!(tree.bounds(), Some((Vec3::ZERO, Vec3::new(1.0, 1.0, 0.0))));
/// ```
#[derive(Clone, Debug, Default)]
pub struct TriangleTree {
    /// Nodes in depth-first order: the first child of a node follows it.
    nodes: Vec<Node>,
    /// Triangles in the order of the leaves.
    triangles: Vec<[Vec3; 3]>,
}

/// Node of the tree: a box around its triangles.
#[derive(Clone, Copy, Debug)]
struct Node {
    min: Vec3,
    max: Vec3,
    /// Index of the first triangle of a leaf, or of the second child of an inner node.
    first: u32,
    /// Number of triangles of a leaf; 0 for an inner node.
    count: u32,
}

/// Triangle that is being sorted into the tree, after twice the centre of its box.
type Item = (Vec3, [Vec3; 3]);

/// Items that are to become a node.
struct Branch {
    items: Range<usize>,
    /// Node of which it is the second child, if it is one.
    parent: Option<usize>,
}

impl TriangleTree {
    /// Builds a tree of `triangles`, whose orientation does not matter. Triangles with a corner that is not finite are
    /// left out.
    pub fn new(triangles: impl IntoIterator<Item = [Vec3; 3]>) -> Self {
        at_once(Self::new_in_pieces(triangles, &mut NoRest))
    }

    /// Does what [`new`](Self::new) does, with rests between its pieces.
    pub(crate) fn new_in_pieces(
        triangles: impl IntoIterator<Item = [Vec3; 3]>,
        rest: &mut impl Rest,
    ) -> impl Future<Output = Self> + Send {
        let items: Vec<Item> = triangles
            .into_iter()
            .filter(|t| t.iter().all(|corner| corner.is_finite()))
            .map(|t| {
                let (min, max) = bounds([&t]);
                (min + max, t)
            })
            .collect();
        Self::of_items(items, rest)
    }

    async fn of_items(mut items: Vec<Item>, rest: &mut impl Rest) -> Self {
        let mut tree = Self { nodes: Vec::with_capacity(items.len()), triangles: Vec::with_capacity(items.len()) };
        let mut open = Vec::new();
        open.extend((!items.is_empty()).then_some(Branch { items: 0..items.len(), parent: None }));
        rest.rest().await;
        while !open.is_empty() {
            let mut done = 0;
            while done < SORTED
                && let Some(branch) = open.pop()
            {
                done += branch.items.len();
                tree.grow(&mut items, branch, &mut open);
            }
            rest.rest().await;
        }
        tree
    }

    /// Appends the node of some of the items. The two below it come next, the first one on top.
    fn grow(&mut self, items: &mut [Item], branch: Branch, open: &mut Vec<Branch>) {
        let Branch { items: range, parent } = branch;
        let node = self.nodes.len();
        if let Some(parent) = parent.and_then(|parent| self.nodes.get_mut(parent)) {
            (parent.first, parent.count) = (node as u32, 0);
        }
        let Some(items) = items.get_mut(range.clone()) else { return };
        let (min, max) = bounds(items.iter().map(|(_, triangle)| triangle));
        self.nodes.push(Node { min, max, first: self.triangles.len() as u32, count: items.len() as u32 });
        if items.len() <= LEAF {
            self.triangles.extend(items.iter().map(|(_, triangle)| triangle));
            return;
        }
        let (low, high) =
            items.iter().fold((Vec3::MAX, Vec3::MIN), |(low, high), &(middle, _)| (low.min(middle), high.max(middle)));
        let axis = (high - low).max_position();
        let half = items.len() / 2;
        items.select_nth_unstable_by(half, |a, b| a.0[axis].total_cmp(&b.0[axis]));
        let middle = range.start + half;
        open.push(Branch { items: middle..range.end, parent: Some(node) });
        open.push(Branch { items: range.start..middle, parent: None });
    }

    /// Returns whether the ray from `origin` meets any triangle, from either side.
    pub fn is_met(&self, ray: &Ray, origin: Vec3) -> bool {
        if self.nodes.is_empty() {
            return false;
        }
        let mut stack = [0u32; DEPTH];
        let (mut left, mut index) = (0, 0usize);
        loop {
            let node = &self.nodes[index];
            let mut next = None;
            if ray.meets_box(origin, node.min, node.max) {
                if node.count == 0 {
                    stack[left] = node.first;
                    left += 1;
                    next = Some(index + 1);
                } else {
                    let first = node.first as usize;
                    let leaf = &self.triangles[first..first + node.count as usize];
                    if leaf.iter().any(|triangle| ray.meets_triangle(origin, triangle)) {
                        return true;
                    }
                }
            }
            index = match next {
                Some(next) => next,
                None if left == 0 => return false,
                None => {
                    left -= 1;
                    stack[left] as usize
                }
            };
        }
    }

    /// Returns the lowest and the highest corner of the box around all triangles, or `None` if there are none.
    pub fn bounds(&self) -> Option<(Vec3, Vec3)> {
        self.nodes.first().map(|root| (root.min, root.max))
    }

    /// Returns the number of triangles.
    pub fn len(&self) -> usize {
        self.triangles.len()
    }

    /// Returns whether there are no triangles.
    pub fn is_empty(&self) -> bool {
        self.triangles.is_empty()
    }
}

/// Returns the lowest and the highest corner of the box around `triangles`.
fn bounds<'a>(triangles: impl IntoIterator<Item = &'a [Vec3; 3]>) -> (Vec3, Vec3) {
    triangles.into_iter().flatten().fold((Vec3::MAX, Vec3::MIN), |(min, max), &p| (min.min(p), max.max(p)))
}
