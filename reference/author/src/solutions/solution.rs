//! A correct or wrong solution and its expected results.

use judging::assignment::Task;

use crate::solutions::sources::Sources;

/// A solution to an assignment: the reference or a variant, possibly with a mistake.
#[derive(Clone, Debug)]
pub struct Solution {
    /// The id of the variant or mistake, the ids of both, or a mutant's name.
    pub id: String,
    /// A description of the solution's method, or of what the wrong code does.
    pub title: String,
    /// Its files.
    pub sources: Sources,
    /// The results that it must have.
    pub expected: Expected,
}

/// The results that a solution must have.
#[derive(Clone, Debug, Default)]
pub struct Expected {
    /// The tasks that the solution is about. A wrong solution must lose points in the first task
    /// and may lose points in the others.
    pub tasks: Vec<Task>,
    /// The only items where a correct solution may lose points.
    pub may_lose: Vec<String>,
    /// The items that a wrong solution fails regardless of the seed.
    pub fails: Vec<String>,
    /// The known mistakes whose hints are true for the solution.
    pub true_hints: Vec<String>,
    /// Whether the code keeps state from one call to the next.
    pub keeps_state: bool,
}

impl Solution {
    /// Returns the task where a wrong solution must lose points.
    ///
    /// # Panics
    ///
    /// Panics if the solution isn't about any task. The reference, for example, isn't.
    pub fn task(&self) -> Task {
        self.expected.tasks[0]
    }
}
