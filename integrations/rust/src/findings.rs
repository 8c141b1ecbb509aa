//! Picks warnings out of what `burnish compile --format line` has said.

/// The lines that are worth a warning of Cargo; the last one of a run counts them only.
pub(crate) fn lines(said: &str) -> impl Iterator<Item = &str> {
    said.lines().filter(|line| line.contains(": warning"))
}
