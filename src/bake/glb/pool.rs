//! Keeps one of a document's lists so that no index changes: what refers to an element, known here or not, finds it.

use std::collections::BTreeSet;

use serde_json::Value;

/// Elements of a list. Those that are not needed any more are free, and new ones take their places first.
#[derive(Debug, Default)]
pub struct Pool {
    elements: Vec<Value>,
    free: BTreeSet<usize>,
}

impl Pool {
    pub fn new(elements: Vec<Value>) -> Self {
        Self { elements, free: BTreeSet::new() }
    }

    pub fn elements(&self) -> &[Value] {
        &self.elements
    }

    pub fn get(&self, index: usize) -> &Value {
        self.elements.get(index).unwrap_or(&Value::Null)
    }

    pub fn len(&self) -> usize {
        self.elements.len()
    }

    /// Whether an element is free.
    pub fn is_free(&self, index: usize) -> bool {
        self.free.contains(&index)
    }

    /// Lets go of an element.
    pub fn release(&mut self, index: usize) {
        if let Some(element) = self.elements.get_mut(index) {
            *element = Value::Null;
            self.free.insert(index);
        }
    }

    /// Adds an element and returns its index.
    pub fn add(&mut self, element: Value) -> usize {
        let index = self.free.pop_first().unwrap_or(self.elements.len());
        self.put(index, element);
        index
    }

    /// Puts an element at an index that is free or the next.
    pub fn put(&mut self, index: usize, element: Value) {
        self.free.remove(&index);
        match self.elements.get_mut(index) {
            Some(old) => *old = element,
            None => self.elements.push(element),
        }
    }

    /// The list, without free elements at its end; `filler` stands at the places of the others.
    pub fn finish(mut self, filler: &Value) -> Vec<Value> {
        while self.elements.len().checked_sub(1).is_some_and(|last| self.free.remove(&last)) {
            self.elements.pop();
        }
        for &index in &self.free {
            if let Some(element) = self.elements.get_mut(index) {
                *element = filler.clone();
            }
        }
        self.elements
    }
}

#[cfg(test)]
mod tests {
    use serde_json::json;

    use super::*;

    #[test]
    fn no_index_changes_and_free_places_are_used_first() {
        let mut pool = Pool::new(vec![json!("a"), json!("b"), json!("c"), json!("d"), json!("e")]);
        [1, 2, 4].into_iter().for_each(|i| pool.release(i));
        assert_eq!(pool.add(json!("x")), 1);
        assert_eq!(pool.finish(&json!(0)), ["a", "x", "", "d"].map(|t| if t.is_empty() { json!(0) } else { json!(t) }));
        let mut pool = Pool::new(vec![json!(1)]);
        assert_eq!((pool.add(json!(2)), pool.finish(&json!(0)).len()), (1, 2));
    }
}
