//! Recognition of decimal commas: in a text file `1,5` is two numbers, and its error is far from telling so.

/// Returns the number with a comma that has probably caused the error at this byte offset, as in `radius: 1,5` or
/// `centre: (0, 1,5, 0)`.
pub fn find(text: &str, at: usize) -> Option<&str> {
    let at = (0..=at.min(text.len())).rev().find(|&at| text.is_char_boundary(at))?;
    around(text, at).or_else(|| in_tuple(text, at))
}

/// Returns the number with a comma that ends, or continues, at the error: a field's name was expected after the comma.
fn around(text: &str, at: usize) -> Option<&str> {
    let is_part = |c: char| c.is_ascii_digit() || c == ',';
    let start = text[..at].trim_end_matches(is_part).len();
    let end = at + text[at..].find(|c| !is_part(c)).unwrap_or(text.len() - at);
    let number = text[start..end].trim_end_matches(',');
    let (whole, decimals) = number.split_once(',')?;
    let is_number = |digits: &str| !digits.is_empty() && digits.chars().all(|c| c.is_ascii_digit());
    // Of a longer list, as in (0,1,0), no number has a comma.
    (is_number(whole) && is_number(decimals) && !text[..start].ends_with('.')).then_some(number)
}

/// Returns the first number with a comma in the brackets round the error, if these have only numbers, more than three.
fn in_tuple(text: &str, at: usize) -> Option<&str> {
    const NUMBERS_OF_A_VECTOR: usize = 3;
    let start = text[..at].rfind('(')? + 1;
    let end = start + text[start..].find([')', '('])?;
    if end < at {
        return None;
    }
    let items: Vec<&str> = text[start..end].split(',').collect();
    let are_numbers = items.iter().all(|item| item.trim().parse::<f64>().is_ok());
    if !are_numbers || items.len() <= NUMBERS_OF_A_VECTOR {
        return None;
    }
    let mut from = start;
    for pair in items.windows(2) {
        let (whole, decimals) = (pair[0], pair[1]);
        let is_tight =
            whole.ends_with(|c: char| c.is_ascii_digit()) && decimals.bytes().all(|byte| byte.is_ascii_digit());
        if is_tight && !whole.contains('.') {
            return Some(text[from..from + whole.len() + 1 + decimals.len()].trim());
        }
        from += whole.len() + 1;
    }
    None
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn comma_is_found_where_a_point_was_meant() {
        for (text, number) in [
            ("Sphere(radius: 1,|5)", Some("1,5")),
            ("Sphere(radius: 1,5|, material: \"m\")", Some("1,5")),
            ("Sphere(radius: |1,5)", Some("1,5")),
            ("Sphere(centre: (0, 1,5, |0), radius: 1)", Some("1,5")),
            ("Sphere(centre: (-1,5, 2, |0), radius: 1)", Some("-1,5")),
            ("(colour: (0,1, 0,3, |0,3))", Some("0,3")),
            ("Sphere(radius: 1, |5)", None),
            ("Sphere(centre: (0,1,0)|, radius: 1)", None),
            ("Sphere(centre: (0, 1, 0, |2), radius: 1)", None),
            ("Sphere(radius: 1.5,|5)", None),
            ("Sphere(radius: 1, raduis|: 2)", None),
            ("|", None),
        ] {
            let at = text.find('|').unwrap();
            assert_eq!(find(&text.replace('|', ""), at), number, "{text}");
        }
    }
}
