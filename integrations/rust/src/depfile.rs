//! Reads what `burnish compile --depfile` writes: a rule of Make with one path on each line.

/// The paths on both sides of a rule: what was written, and what was read.
pub(crate) fn parsed(rule: &str) -> (Vec<String>, Vec<String>) {
    let mut outputs = Vec::new();
    let mut inputs = Vec::new();
    let mut is_output = true;
    for line in rule.lines() {
        let line = line.strip_suffix(" \\").unwrap_or(line).trim_start();
        match line.strip_suffix(':') {
            // Colons within paths have a backslash before them.
            Some(last) if is_output && !last.ends_with('\\') => {
                outputs.push(plain(last));
                is_output = false;
            }
            _ if is_output => outputs.push(plain(line)),
            _ => inputs.push(plain(line)),
        }
    }
    (outputs, inputs)
}

/// A path without what escapes characters in it.
fn plain(escaped: &str) -> String {
    let mut path = String::with_capacity(escaped.len());
    let mut rest = escaped;
    while !rest.is_empty() {
        let (length, letters) = first_of(rest);
        path.push_str(&letters);
        rest = &rest[length..];
    }
    path
}

/// How long the beginning of a text is that is read as one, and what it stands for. Backslashes are
/// doubled before a blank, which has one more itself, and stand for themselves elsewhere.
fn first_of(text: &str) -> (usize, String) {
    let behind = text.trim_start_matches('\\');
    let slashes = text.len() - behind.len();
    match (slashes, behind.chars().next()) {
        (0, Some('$')) if behind.starts_with("$$") => (2, "$".to_owned()),
        (0, Some(letter)) => (letter.len_utf8(), letter.to_string()),
        (_, Some(blank @ (' ' | '\t'))) => (slashes + 1, format!("{}{blank}", kept(slashes / 2))),
        (_, Some(mark @ ('#' | ':'))) => (slashes + 1, format!("{}{mark}", kept(slashes - 1))),
        _ => (slashes, kept(slashes)),
    }
}

fn kept(slashes: usize) -> String {
    "\\".repeat(slashes)
}

#[cfg(test)]
mod tests {
    use super::parsed;

    #[test]
    fn both_sides_of_a_rule() {
        let rule = "out/a.wgsl \\\n  out/a.json: \\\n  a.burnish \\\n  shared/b.burnish\n";
        let (outputs, inputs) = parsed(rule);
        assert_eq!(outputs, ["out/a.wgsl", "out/a.json"]);
        assert_eq!(inputs, ["a.burnish", "shared/b.burnish"]);
    }

    #[test]
    fn characters_that_are_escaped() {
        let rule = "C:\\o\\x\\ y\\:: \\\n  a\\\\\\ b \\\n  $$c\\#d\\e\\:\\$$\n";
        let (outputs, inputs) = parsed(rule);
        assert_eq!(outputs, ["C:\\o\\x y:"]);
        assert_eq!(inputs, ["a\\ b", "$c#d\\e:\\$"]);
    }

    #[test]
    fn nothing_was_read() {
        assert_eq!(
            parsed("out/a.json:\n"),
            (vec!["out/a.json".to_owned()], Vec::new())
        );
    }
}
