use super::*;

const FIGURES: &str = include_str!("../../../../docs/figures.md");

/// Rows of the tables of a section (or of all) of `docs/figures.md`: the labels of the first cell, and the second cell.
/// Labels of the window that are in italics keep their asterisks.
fn rows(section: Option<&str>) -> Vec<(Vec<String>, String)> {
    let text = section.map_or(FIGURES, |section| {
        let start = FIGURES.find(&format!("## {section}")).expect("the section");
        FIGURES[start + 3..].split("\n## ").next().unwrap_or_default()
    });
    let cells = |line: &str| line.strip_prefix("| ").map(|row| row.split(" | ").map(str::to_owned).collect::<Vec<_>>());
    let labels = |cell: &str| cell.split([',', ';']).map(|label| label.trim().replace(['`', '"'], "")).collect();
    let rows = text.lines().filter_map(cells).filter(|cells| cells.len() > 1);
    rows.map(|cells| (labels(&cells[0]), cells[1].trim_end_matches(" |").to_owned())).collect()
}

fn all() -> impl Iterator<Item = Definition> {
    DefinitionGroup::ALL.iter().flat_map(|group| group.definitions).copied()
}

fn is_label(label: &str, definition: Definition) -> bool {
    label.trim_matches('*') == definition.name[0]
}

#[test]
fn words_are_those_of_the_documentation() {
    let documented: Vec<_> = rows(Some("Words of a run")).split_off(1);
    let defined = Definition::WORDS.iter().map(|word| (vec![word.name[0].to_owned()], word.text[0].to_owned()));
    assert_eq!(documented, defined.collect::<Vec<_>>());
}

#[test]
fn every_figure_has_its_row_in_the_documentation() {
    let rows = rows(None);
    for definition in all() {
        let is_documented = rows.iter().any(|(labels, _)| labels.iter().any(|label| is_label(label, definition)));
        assert!(is_documented, "docs/figures.md does not have {:?}", definition.name[0]);
    }
}

#[test]
fn every_documented_label_of_the_window_has_a_definition() {
    let shown = rows(Some("While a run goes on")).into_iter().chain(rows(Some("Where the machines' time went")));
    let is_head = |labels: &[String]| ["figure", "word", "part"].contains(&&*labels[0]);
    let is_defined = |labels: &[String]| labels.iter().any(|label| all().any(|defined| is_label(label, defined)));
    // Two figures of the time budget stand in sentences only.
    let is_in_sentences = |labels: &[String]| ["waited at the parent", "estimating"].contains(&&*labels[0]);
    for (labels, _) in shown.filter(|(labels, _)| !is_head(labels) && !is_in_sentences(labels)) {
        assert!(is_defined(&labels), "no definition of {labels:?}");
    }
    for (labels, _) in rows(None) {
        let captions: Vec<_> =
            labels.into_iter().filter(|label| label.starts_with('*') && label.ends_with('*')).collect();
        // A term of the tree of rays is explained beside it.
        assert!(captions.is_empty() || captions == ["*counts*"] || is_defined(&captions), "{captions:?}");
    }
}

#[test]
fn every_activity_has_its_own_definition() {
    use Activity::*;
    let activities = [
        NoBand, Tracing, SpeedZero, Paused, Offering, Asking, InLine, Receiving, Idle, Retired, Asleep, NoMore, Hung,
        CutOff, Off, Spare, Done,
    ];
    assert_eq!(activities.map(Definition::of_activity), Definition::NOW);
}

#[test]
fn texts_are_short_sentences() {
    for definition in all() {
        for text in definition.text {
            assert!(text.len() < 240 && text.ends_with(['.', '…', '1']), "{text}");
            assert!(text.matches(". ").count() < 3 && !text.contains("  "), "{text}");
        }
    }
}
