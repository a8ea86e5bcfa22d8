//! A report in Markdown.

/// A report in Markdown, written line by line.
pub(super) struct Report {
    text: String,
}

impl Report {
    /// Begins a report with its title.
    pub fn titled(title: &str) -> Self {
        Self { text: format!("# {title}\n\n") }
    }

    /// Appends a line, or several with line breaks between them.
    pub fn line(&mut self, line: impl AsRef<str>) {
        self.text.push_str(line.as_ref());
        self.text.push('\n');
    }

    /// Returns the text of the report's file.
    pub fn into_text(self) -> String {
        self.text
    }
}
