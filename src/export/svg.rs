//! A display list as SVG, on white, for slides and paper.

use std::collections::BTreeSet;
use std::fmt::Write;

use super::hatch;
use crate::font::PLEX_NAME;
use crate::palette::{PRINT, Rgb, node_colour, readable, text_on};
use crate::view::{Anchor, Hue, Ink, Mark, Point, TextSize};

/// Returns a display list for a canvas of `size` as SVG.
pub fn to_svg(marks: &[Mark], size: Point) -> String {
    svg_text(marks, size, false)
}

/// Like [`to_svg`], but also hatches boxes and larger discs in a node's colour, each node in its own way, to
/// distinguish them in print without colour.
pub fn to_hatched_svg(marks: &[Mark], size: Point) -> String {
    svg_text(marks, size, true)
}

fn svg_text(marks: &[Mark], size: Point, hatched: bool) -> String {
    let [width, height] = size.map(number);
    let mut svg = Svg { text: String::new(), hatched };
    svg.put(format_args!(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{width}\" height=\"{height}\" \
         viewBox=\"0 0 {width} {height}\" font-family=\"'{PLEX_NAME}', system-ui, 'Noto Sans', Arial, sans-serif\">\n",
    ));
    if hatched {
        svg.put_hatches(marks);
    }
    svg.put(format_args!("<rect width=\"{width}\" height=\"{height}\" fill=\"{}\"/>\n", hex(PRINT.ground)));
    marks.iter().for_each(|mark| svg.put_mark(mark));
    svg.text.push_str("</svg>\n");
    svg.text
}

/// Writer of an SVG file.
struct Svg {
    text: String,
    hatched: bool,
}

impl Svg {
    fn put_mark(&mut self, mark: &Mark) {
        match mark {
            Mark::Disc { centre, radius, ink } => {
                // A hatch would not be visible on a smaller disc.
                let fill = if *radius >= hatch::TILE_SIDE { self.fill(*ink) } else { self.paint("fill", *ink) };
                let ([x, y], r) = (centre.map(number), number(*radius));
                self.put(format_args!("<circle cx=\"{x}\" cy=\"{y}\" r=\"{r}\"{fill}/>\n"));
            }
            Mark::Box { centre, half, round, ink } => {
                let [x, y] = [0, 1].map(|i| number(centre[i] - half[i]));
                let ([width, height], fill) = (half.map(|half| number(2.0 * half)), self.fill(*ink));
                let round = number(round.min(half[0]).min(half[1]));
                self.put(format_args!(
                    "<rect x=\"{x}\" y=\"{y}\" width=\"{width}\" height=\"{height}\" rx=\"{round}\"{fill}/>\n"
                ));
            }
            Mark::Line { points, width, ink } => {
                let closed = points.len() > 3 && distance(points[0], points[points.len() - 1]) < 0.05;
                let shape = if closed { "polygon" } else { "polyline" };
                let (width, stroke) = (number(*width), self.paint("stroke", *ink));
                let point_list = point_list(&points[..points.len() - usize::from(closed)]);
                self.put(format_args!(
                    "<{shape} points=\"{point_list}\" fill=\"none\"{stroke} stroke-width=\"{width}\" \
                     stroke-linejoin=\"round\"/>\n"
                ));
            }
            Mark::Trail { points, width, ink } => self.put_trail(points, *width, *ink),
            Mark::Label { at, anchor, text, size, ink } => self.put_label(*at, *anchor, text, *size, *ink),
        }
    }

    /// Writes the hatches of all nodes that have boxes or discs.
    fn put_hatches(&mut self, marks: &[Mark]) {
        let node = |mark: &Mark| match mark {
            Mark::Box { ink: Ink { hue: Hue::Node(node), .. }, .. }
            | Mark::Disc { ink: Ink { hue: Hue::Node(node), .. }, .. } => Some(*node),
            _ => None,
        };
        let nodes: BTreeSet<u16> = marks.iter().filter_map(node).collect();
        self.text.push_str("<defs>\n");
        for node in nodes {
            let (colour, pattern) = (self.colour(Hue::Node(node)), hatch::pattern(node));
            let [ground, line] = [colour, text_on(colour)].map(hex);
            let side = hatch::TILE_SIDE;
            self.put(format_args!(
                "<pattern id=\"node-{node}\" width=\"{side}\" height=\"{side}\" patternUnits=\"userSpaceOnUse\">\
                 <rect width=\"{side}\" height=\"{side}\" fill=\"{ground}\"/>\
                 <path d=\"{pattern}\" fill=\"none\" stroke=\"{line}\" stroke-width=\"1.1\" \
                 stroke-opacity=\"0.8\"/></pattern>\n"
            ));
        }
        self.text.push_str("</defs>\n");
    }

    /// Writes a trail as segments that grow wider and more opaque.
    fn put_trail(&mut self, points: &[Point], width: f32, ink: Ink) {
        let last = points.len().saturating_sub(1);
        let sides = |i: usize| {
            let (before, after) = (points[i.saturating_sub(1)], points[(i + 1).min(last)]);
            // A segment without length has no sides.
            let length = distance(before, after);
            let half = if length > 1e-3 { width / 2.0 * i as f32 / last as f32 / length } else { 0.0 };
            let ([x, y], [across, down]) = (points[i], [after[1] - before[1], before[0] - after[0]]);
            [[x - across * half, y - down * half], [x + across * half, y + down * half]]
        };
        for i in 0..last {
            let ([a, b], [c, d]) = (sides(i), sides(i + 1));
            let share = (i as f32 + 0.5) / last as f32;
            let fill = self.paint("fill", Ink { alpha: ink.alpha * share * share, ..ink });
            self.put(format_args!("<polygon points=\"{}\"{fill}/>\n", point_list(&[a, b, d, c])));
        }
    }

    fn put_label(&mut self, [x, y]: Point, anchor: Anchor, text: &str, size: TextSize, ink: Ink) {
        let units = size.units();
        // Half a digit's height below the middle; many programs support no other baseline.
        let (x, y) = (number(x), number(y + 0.36 * units));
        let anchor = match anchor {
            Anchor::Left => "start",
            Anchor::Centre => "middle",
            Anchor::Right => "end",
        };
        let weight = if matches!(size, TextSize::Small(_)) { 400 } else { 600 };
        let own = self.colour(ink.hue);
        let colour = if matches!(ink.hue, Hue::Node(_)) { readable(own, PRINT.ground) } else { own };
        let (fill, halo) = (paint("fill", colour, ink.alpha), self.halo(ink.hue, units));
        let (size, text) = (number(units), escaped(text));
        self.put(format_args!(
            "<text x=\"{x}\" y=\"{y}\" text-anchor=\"{anchor}\" font-size=\"{size}\" \
             font-weight=\"{weight}\"{fill}{halo}>{text}</text>\n"
        ));
    }

    fn colour(&self, hue: Hue) -> Rgb {
        let node = |node: u16| node_colour(node.into());
        match hue {
            Hue::Node(i) => node(i),
            Hue::OnNode(i) => text_on(node(i)),
            Hue::Text => PRINT.text,
            Hue::Quiet => PRINT.quiet,
            Hue::Accent => PRINT.accent,
            Hue::Hairline => PRINT.hairline,
            Hue::Ground => PRINT.ground,
            Hue::Fixed(colour) => colour,
        }
    }

    /// Returns the attributes of a text's outline, which separates it from a hatch below.
    fn halo(&self, hue: Hue, units: f32) -> String {
        match hue {
            Hue::OnNode(node) if self.hatched => {
                let (colour, width) = (hex(self.colour(Hue::Node(node))), number(0.3 * units));
                format!(
                    " stroke=\"{colour}\" stroke-width=\"{width}\" stroke-linejoin=\"round\" paint-order=\"stroke\""
                )
            }
            _ => String::new(),
        }
    }

    /// Returns the fill of a box or a disc.
    fn fill(&self, ink: Ink) -> String {
        match ink.hue {
            Hue::Node(node) if self.hatched => attributes("fill", &format!("url(#node-{node})"), ink.alpha),
            _ => self.paint("fill", ink),
        }
    }

    fn paint(&self, what: &str, ink: Ink) -> String {
        paint(what, self.colour(ink.hue), ink.alpha)
    }

    fn put(&mut self, what: std::fmt::Arguments<'_>) {
        self.text.write_fmt(what).expect("writing to a String cannot fail");
    }
}

/// Returns the attributes of a fill or a stroke.
fn paint(what: &str, colour: Rgb, alpha: f32) -> String {
    attributes(what, &hex(colour), alpha)
}

fn attributes(what: &str, colour: &str, alpha: f32) -> String {
    let opacity = number(alpha.clamp(0.0, 1.0));
    if opacity == "1" {
        format!(" {what}=\"{colour}\"")
    } else {
        format!(" {what}=\"{colour}\" {what}-opacity=\"{opacity}\"")
    }
}

fn hex([r, g, b]: Rgb) -> String {
    format!("#{r:02x}{g:02x}{b:02x}")
}

fn point_list(points: &[Point]) -> String {
    let point_list: Vec<_> = points.iter().map(|&[x, y]| format!("{},{}", number(x), number(y))).collect();
    point_list.join(" ")
}

fn distance([x, y]: Point, [u, v]: Point) -> f32 {
    (x - u).hypot(y - v)
}

/// Formats a number with at most two decimals; NaN and infinities become 0.
fn number(value: f32) -> String {
    let rounded = format!("{:.2}", if value.is_finite() { value } else { 0.0 });
    match rounded.trim_end_matches('0').trim_end_matches('.') {
        "-0" => "0".into(),
        short => short.into(),
    }
}

/// Escapes a text for XML, on one line.
fn escaped(text: &str) -> String {
    let mut safe = String::new();
    for letter in text.chars() {
        match letter {
            '<' => safe.push_str("&lt;"),
            '>' => safe.push_str("&gt;"),
            '&' => safe.push_str("&amp;"),
            '"' => safe.push_str("&quot;"),
            '\u{fffe}' | '\u{ffff}' => {}
            _ if letter.is_control() => safe.push(' '),
            _ => safe.push(letter),
        }
    }
    safe
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;
    use roxmltree::Document;

    use super::*;

    /// Generates places and lengths, and sometimes any float.
    fn numbers() -> impl Strategy<Value = f32> {
        prop_oneof![9 => -50.0..1000.0f32, 1 => any::<f32>()]
    }

    fn inks() -> impl Strategy<Value = Ink> {
        let hues = prop_oneof![
            (0..40u16).prop_map(Hue::Node),
            (0..40u16).prop_map(Hue::OnNode),
            prop::sample::select(vec![Hue::Text, Hue::Quiet, Hue::Accent, Hue::Hairline, Hue::Ground]),
        ];
        (hues, 0.0..1.0f32).prop_map(|(hue, alpha)| Ink { hue, alpha })
    }

    fn marks() -> impl Strategy<Value = Mark> {
        let point = || [numbers(), numbers()];
        let points = || prop::collection::vec(point(), 2..12);
        let sizes = prop_oneof![
            (0.5..3.0f32).prop_map(TextSize::Small),
            (0.5..3.0f32).prop_map(TextSize::Body),
            numbers().prop_map(TextSize::Fit),
        ];
        let anchors = prop::sample::select(vec![Anchor::Left, Anchor::Centre, Anchor::Right]);
        let text = prop_oneof![any::<String>(), "[<&\">'\n\t\u{0}\u{1b}\u{85}\u{fffe}\u{ffff} a]{0,20}"];
        prop_oneof![
            (point(), numbers(), inks()).prop_map(|(centre, radius, ink)| Mark::Disc { centre, radius, ink }),
            (point(), point(), numbers(), inks()).prop_map(|(centre, half, round, ink)| Mark::Box {
                centre,
                half,
                round,
                ink
            }),
            (points(), numbers(), inks()).prop_map(|(points, width, ink)| Mark::Line { points, width, ink }),
            (points(), numbers(), inks()).prop_map(|(points, width, ink)| Mark::Trail { points, width, ink }),
            (point(), anchors, text, sizes, inks()).prop_map(|(at, anchor, text, size, ink)| Mark::Label {
                at,
                anchor,
                text,
                size,
                ink
            }),
        ]
    }

    proptest! {
        #[test]
        fn every_display_list_becomes_valid_xml(marks in prop::collection::vec(marks(), 0..12)) {
            let text = to_svg(&marks, [640.0, 480.0]);
            let document = Document::parse(&text).map_err(|error| TestCaseError::fail(format!("{error}: {text}")))?;
            let pieces = marks.iter().map(|mark| if let Mark::Trail { points, .. } = mark { points.len() - 1 } else { 1 });
            let shapes: Vec<_> = document.root_element().children().filter(|node| node.is_element()).collect();
            prop_assert_eq!(shapes.len(), 1 + pieces.sum::<usize>());
            for attribute in shapes.iter().flat_map(|shape| shape.attributes()) {
                for number in attribute.value().split([' ', ',']).filter_map(|number| number.split_once('.')) {
                    prop_assert!(number.1.len() <= 2, "{attribute:?}");
                }
            }
        }

        #[test]
        fn label_text_survives_escaping(text in "[ -~äß←…]{1,30}") {
            let (ink, size) = (Hue::Text.full(), TextSize::Body(1.0));
            let label = Mark::Label { at: [0.0; 2], anchor: Anchor::Left, text: text.clone(), size, ink };
            let svg = to_svg(&[label], [100.0; 2]);
            let document = Document::parse(&svg).expect("it is XML");
            let said = document.descendants().find(|node| node.has_tag_name("text")).and_then(|node| node.text());
            prop_assert_eq!(said, Some(&*text));
        }
    }

    /// Returns the element and the attributes of a single mark.
    fn drawn(mark: Mark) -> Vec<(String, String)> {
        let text = to_svg(&[mark], [640.0, 480.0]);
        let document = Document::parse(&text).expect("it is XML");
        let shape = document.root_element().children().filter(|node| node.is_element()).nth(1).expect("a mark");
        let name = ("".into(), shape.tag_name().name().into());
        std::iter::once(name).chain(shape.attributes().map(|a| (a.name().into(), a.value().into()))).collect()
    }

    fn is(attributes: &[(String, String)], wanted: &[(&str, &str)]) -> bool {
        wanted.iter().all(|(name, value)| attributes.iter().any(|(n, v)| n == name && v == value))
    }

    #[test]
    fn marks_have_their_shapes_and_places() {
        let ink = Hue::Node(0).faint(0.5);
        let disc = drawn(Mark::Disc { centre: [1.0, 2.5], radius: 3.337, ink });
        assert!(
            is(&disc, &[("", "circle"), ("cx", "1"), ("cy", "2.5"), ("r", "3.34"), ("fill-opacity", "0.5")]),
            "{disc:?}"
        );
        assert!(is(&disc, &[("fill", &hex(node_colour(0)))]), "{disc:?}");
        let rect = drawn(Mark::Box { centre: [10.0, 10.0], half: [4.0, 2.0], round: 9.0, ink });
        assert!(is(&rect, &[("x", "6"), ("y", "8"), ("width", "8"), ("height", "4"), ("rx", "2")]), "{rect:?}");
        let points = vec![[0.0, 0.0], [5.0, 0.0], [5.0, 5.0], [0.0, 0.0]];
        let closed = drawn(Mark::Line { points: points.clone(), width: 1.0, ink });
        assert!(is(&closed, &[("", "polygon"), ("points", "0,0 5,0 5,5"), ("fill", "none")]), "{closed:?}");
        let open = drawn(Mark::Line { points: points[..3].to_vec(), width: 1.0, ink });
        assert!(is(&open, &[("", "polyline"), ("points", "0,0 5,0 5,5")]), "{open:?}");
    }

    #[test]
    fn trail_grows_from_nothing_to_full_width() {
        let points = vec![[0.0, 0.0], [10.0, 0.0], [20.0, 0.0]];
        let text = to_svg(&[Mark::Trail { points, width: 4.0, ink: Hue::Text.full() }], [640.0, 480.0]);
        let document = Document::parse(&text).expect("it is XML");
        let pieces: Vec<_> = document.descendants().filter_map(|node| node.attribute("points")).collect();
        assert_eq!(pieces, ["0,0 0,0 10,-1 10,1", "10,1 10,-1 20,-2 20,2"]);
        let still = Mark::Trail { points: vec![[9.0, 9.0]; 2], width: 4.0, ink: Hue::Text.full() };
        assert!(to_svg(&[still], [640.0, 480.0]).contains("points=\"9,9 9,9 9,9 9,9\""));
    }

    #[test]
    fn pale_labels_are_darkened_on_paper() {
        let label = |hue: Hue| {
            let (anchor, size) = (Anchor::Right, TextSize::Body(1.0));
            drawn(Mark::Label { at: [9.0, 100.0], anchor, text: "ring".into(), size, ink: hue.full() })
        };
        let yellow = label(Hue::Node(5));
        assert!(is(&yellow, &[("fill", &hex(readable(node_colour(5), PRINT.ground)))]), "{yellow:?}");
        assert!(is(&yellow, &[("x", "9"), ("y", "105.76"), ("text-anchor", "end"), ("font-size", "16")]), "{yellow:?}");
        let on_yellow = label(Hue::OnNode(5));
        assert!(is(&on_yellow, &[("fill", &hex(text_on(node_colour(5))))]), "{on_yellow:?}");
    }
    #[test]
    fn machines_are_hatched_and_their_numbers_are_outlined() {
        let disc = |radius| Mark::Disc { centre: [50.0; 2], radius, ink: Hue::Node(1).full() };
        let (anchor, size, text) = (Anchor::Centre, TextSize::Body(1.0), "2".to_owned());
        let label = Mark::Label { at: [50.0; 2], anchor, text, size, ink: Hue::OnNode(1).full() };
        let text = to_hatched_svg(&[disc(30.0), disc(3.0), label], [100.0; 2]);
        let document = Document::parse(&text).expect("it is XML");
        let all = |name: &str, attribute: &str| -> Vec<String> {
            let named = document.descendants().filter(|node| node.has_tag_name(name));
            named.map(|node| node.attribute(attribute).unwrap_or_default().to_owned()).collect()
        };
        let colour = hex(node_colour(1));
        assert_eq!(all("circle", "fill"), ["url(#node-1)", &colour]);
        assert_eq!(all("text", "stroke"), [colour]);
        assert_eq!(all("pattern", "id"), ["node-1"]);
    }
}
