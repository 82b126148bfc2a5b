//! Keeps balls in a tree, in which those near others are found quickly and single ones can be moved.

use super::ball::Ball;

/// Place of an item that is not in the tree.
const NONE: u32 = u32::MAX;

/// Balls of numbered items.
///
/// Moving an item costs as much as the tree is deep. Bounds are right at any time; after as many movements as there are
/// items the tree is built again, as it finds less quickly the further items have moved.
#[derive(Clone, Debug, Default)]
pub(super) struct BallTree {
    /// Nodes in depth-first order: the first child of a node follows it.
    nodes: Vec<Node>,
    /// Leaf of each item, or [`NONE`].
    leaves: Vec<u32>,
    /// Number of movements since the tree was built.
    moves: usize,
}

/// Node of the tree: a ball around those of its children.
#[derive(Clone, Copy, Debug)]
struct Node {
    ball: Ball,
    parent: u32,
    /// Second child of an inner node.
    second: u32,
    /// Item of a leaf; [`NONE`] for an inner node.
    item: u32,
}

impl BallTree {
    /// Builds the tree of the items' balls. Items without a ball are never found.
    pub fn new(balls: impl IntoIterator<Item = Option<Ball>>) -> Self {
        let mut leaves = Vec::new();
        let mut items = Vec::new();
        for (item, ball) in balls.into_iter().enumerate() {
            leaves.push(NONE);
            items.extend(
                ball.filter(|ball| ball.center.is_finite() && ball.radius.is_finite()).map(|b| (item as u32, b)),
            );
        }
        let mut tree = Self { nodes: Vec::with_capacity(2 * items.len()), leaves, moves: 0 };
        if !items.is_empty() {
            tree.grow(&mut items, NONE);
        }
        tree
    }

    /// Appends the node of `items` and all nodes below it.
    fn grow(&mut self, items: &mut [(u32, Ball)], parent: u32) -> Ball {
        let node = self.nodes.len();
        if let [(item, ball)] = items {
            self.nodes.push(Node { ball: *ball, parent, second: NONE, item: *item });
            self.leaves[*item as usize] = node as u32;
            return *ball;
        }
        self.nodes.push(Node { ball: Ball::default(), parent, second: NONE, item: NONE });
        let centers = || items.iter().map(|(_, ball)| ball.center);
        let low = centers().fold(bevy::math::Vec3::MAX, |low, center| low.min(center));
        let high = centers().fold(bevy::math::Vec3::MIN, |high, center| high.max(center));
        let axis = (high - low).max_position();
        let half = items.len() / 2;
        items.select_nth_unstable_by(half, |a, b| a.1.center[axis].total_cmp(&b.1.center[axis]).then(a.0.cmp(&b.0)));
        let (near, far) = items.split_at_mut(half);
        let first = self.grow(near, node as u32);
        let second = self.nodes.len() as u32;
        let ball = first.join(self.grow(far, node as u32));
        (self.nodes[node].ball, self.nodes[node].second) = (ball, second);
        ball
    }

    /// Moves an item. Items that had no ball when the tree was built stay out of it.
    pub fn set(&mut self, item: usize, ball: Ball) {
        let Some(&leaf) = self.leaves.get(item).filter(|&&leaf| leaf != NONE) else { return };
        self.nodes[leaf as usize].ball = ball;
        self.moves += 1;
        if self.moves > self.leaves.len() {
            let balls: Vec<Option<Ball>> = (0..self.leaves.len()).map(|item| self.ball(item)).collect();
            *self = Self::new(balls);
            return;
        }
        let mut node = self.nodes[leaf as usize].parent;
        while node != NONE {
            let at = node as usize;
            let ball = self.nodes[at + 1].ball.join(self.nodes[self.nodes[at].second as usize].ball);
            self.nodes[at].ball = ball;
            node = self.nodes[at].parent;
        }
    }

    /// Returns the ball of an item, if it has one.
    pub fn ball(&self, item: usize) -> Option<Ball> {
        let leaf = self.leaves.get(item).filter(|&&leaf| leaf != NONE)?;
        Some(self.nodes[*leaf as usize].ball)
    }

    /// Calls `found` with each item whose ball `wanted` asks for, in no particular order, and returns the number of
    /// balls that were looked at. `wanted` must ask for every ball around one that it asks for.
    pub fn find(&self, wanted: impl Fn(&Ball) -> bool, mut found: impl FnMut(usize)) -> usize {
        let mut looked_at = 0;
        let mut open: Vec<u32> = Vec::with_capacity(32);
        open.extend((!self.nodes.is_empty()).then_some(0));
        while let Some(at) = open.pop() {
            let node = &self.nodes[at as usize];
            looked_at += 1;
            if !wanted(&node.ball) {
                continue;
            }
            if node.item == NONE {
                open.extend([node.second, at + 1]);
            } else {
                found(node.item as usize);
            }
        }
        looked_at
    }
}
