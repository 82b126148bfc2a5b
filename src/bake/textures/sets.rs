//! Keeps disjoint sets.

/// Sets of the numbers below a count.
pub struct Sets(Vec<u32>);

impl Sets {
    /// Each number in a set of its own.
    pub fn new(count: usize) -> Self {
        Self((0..count as u32).collect())
    }

    /// The least number of the set that `i` is in.
    pub fn root(&mut self, mut i: u32) -> u32 {
        while self.0[i as usize] != i {
            self.0[i as usize] = self.0[self.0[i as usize] as usize];
            i = self.0[i as usize];
        }
        i
    }

    /// Makes one set of two.
    pub fn join(&mut self, a: u32, b: u32) {
        let (a, b) = (self.root(a), self.root(b));
        self.0[a.max(b) as usize] = a.min(b);
    }

    /// All sets, by their least numbers, each ascending.
    pub fn groups(&mut self) -> Vec<Vec<u32>> {
        let mut groups: Vec<Vec<u32>> = Vec::new();
        let mut at = vec![0; self.0.len()];
        for i in 0..self.0.len() as u32 {
            let root = self.root(i);
            if root == i {
                at[i as usize] = groups.len();
                groups.push(Vec::new());
            }
            groups[at[root as usize]].push(i);
        }
        groups
    }
}
