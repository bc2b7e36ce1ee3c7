//! What is wrong with a part of what is asked: the key, the message, the cure.

/// A refusal without its place in a file; whoever read the file adds that.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Wrong {
    /// Path of the key within the part that was checked; empty for the part itself.
    pub key: String,
    pub message: String,
    pub help: String,
}

impl Wrong {
    pub fn new(key: impl Into<String>, message: impl Into<String>, help: impl Into<String>) -> Self {
        Self { key: key.into(), message: message.into(), help: help.into() }
    }

    /// The same, further inside.
    pub fn inside(self, outer: &str) -> Self {
        let key = if self.key.is_empty() { outer.to_owned() } else { format!("{outer}.{}", self.key) };
        Self { key, ..self }
    }
}
