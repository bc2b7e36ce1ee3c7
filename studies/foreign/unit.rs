//! Units of columns: products, quotients, powers and roots of SI units with prefixes, and a few others that are in use.

/// A unit: what its numbers are multiplied by, and its powers of m, kg and s in sixtieths.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Unit {
    pub factor: f64,
    powers: [i64; 3],
}

/// Whole powers, roots up to the sixth and decimals such as 0.5 and 0.25 are whole numbers of these.
const PARTS: i64 = 60;
/// Longer texts are no units.
const LONGEST: usize = 80;
const DEEPEST: usize = 8;

const fn of(factor: f64, powers: [i64; 3]) -> Unit {
    Unit { factor, powers: [powers[0] * PARTS, powers[1] * PARTS, powers[2] * PARTS] }
}

/// Units by name, and whether they take prefixes.
const NAMES: [(&str, Unit, bool); 15] = [
    ("m", of(1.0, [1, 0, 0]), true),
    ("g", of(1e-3, [0, 1, 0]), true),
    ("s", of(1.0, [0, 0, 1]), true),
    ("N", of(1.0, [1, 1, -2]), true),
    ("Pa", of(1.0, [-1, 1, -2]), true),
    ("bar", of(1e5, [-1, 1, -2]), false),
    ("J", of(1.0, [2, 1, -2]), true),
    ("Hz", of(1.0, [0, 0, -1]), true),
    ("rad", of(1.0, [0, 0, 0]), true),
    ("%", of(0.01, [0, 0, 0]), false),
    ("in", of(0.0254, [1, 0, 0]), false),
    ("ft", of(0.3048, [1, 0, 0]), false),
    ("psi", of(6_894.757_293_168_361, [-1, 1, -2]), false),
    ("ksi", of(6_894_757.293_168_361, [-1, 1, -2]), false),
    ("kgf", of(9.806_65, [1, 1, -2]), false),
];

const PREFIXES: [(&str, f64); 10] = [
    ("p", 1e-12),
    ("n", 1e-9),
    ("u", 1e-6),
    ("µ", 1e-6),
    ("μ", 1e-6),
    ("m", 1e-3),
    ("c", 1e-2),
    ("k", 1e3),
    ("M", 1e6),
    ("G", 1e9),
];

/// What is suggested for a word that is none.
const COMMON: [&str; 20] = [
    "m", "mm", "um", "km", "s", "ms", "us", "ns", "kg", "g", "N", "kN", "Pa", "kPa", "MPa", "GPa", "psi",
    "ksi", "rad", "Hz",
];

/// What is wrong with a text, and what to write.
#[derive(Debug, Clone, PartialEq)]
pub struct NoUnit {
    pub message: String,
    pub help: String,
}

impl Unit {
    /// Reads `MPa*sqrt(mm)`, `mm/us`, `kg m^-3`, `MPa m^0.5`, `1`.
    pub fn parse(text: &str) -> Result<Self, NoUnit> {
        if text.len() > LONGEST {
            return Err(no("this is too long for a unit", "write one such as MPa*sqrt(mm)"));
        }
        let letters: Vec<char> = text.trim().replace("**", "^").chars().collect();
        let mut reader = Reader { letters, at: 0 };
        let unit = reader.product(0)?;
        match reader.peek() {
            None if unit.factor.is_finite() && unit.factor > 0.0 => Ok(unit),
            None => Err(no("its factor is no number", "write a unit such as MPa*sqrt(mm)")),
            Some(letter) => Err(no(&format!("`{letter}` has no meaning in a unit"), HELP)),
        }
    }

    /// Whether both measure the same kind of quantity.
    pub fn is_like(&self, other: &Self) -> bool {
        self.powers == other.powers
    }

    fn times(self, other: Self, sign: i64) -> Self {
        let factor = if sign < 0 { self.factor / other.factor } else { self.factor * other.factor };
        Self { factor, powers: [0, 1, 2].map(|i| self.powers[i] + sign * other.powers[i]) }
    }

    fn power(self, power: f64) -> Option<Self> {
        let powers = self.powers.map(|one| one as f64 * power);
        let whole = powers.iter().all(|one| (one - one.round()).abs() < 1e-6 && one.abs() < 1e6);
        let factor = if power == 0.5 { self.factor.sqrt() } else { libm::pow(self.factor, power) };
        whole.then(|| Self { factor, powers: powers.map(|one| one.round() as i64) })
    }
}

const HELP: &str = "units are made of m, g, s, N, Pa, J, Hz, rad, %, in, psi, ksi with prefixes, * / ^ and sqrt( ): MPa*sqrt(mm), mm/us";

fn no(message: &str, help: &str) -> NoUnit {
    NoUnit { message: message.to_owned(), help: help.to_owned() }
}

struct Reader {
    letters: Vec<char>,
    at: usize,
}

impl Reader {
    fn peek(&self) -> Option<char> {
        self.letters.get(self.at).copied()
    }

    fn skip_blanks(&mut self) -> bool {
        let from = self.at;
        while self.peek().is_some_and(char::is_whitespace) {
            self.at += 1;
        }
        self.at > from
    }

    fn product(&mut self, depth: usize) -> Result<Unit, NoUnit> {
        if depth > DEEPEST {
            return Err(no("brackets are nested too deeply", HELP));
        }
        let mut unit = self.factor(depth)?;
        loop {
            self.skip_blanks();
            let sign = match self.peek() {
                Some('*' | '·' | '.') => {
                    self.at += 1;
                    1
                }
                Some('/') => {
                    self.at += 1;
                    -1
                }
                Some(letter) if letter.is_alphabetic() || letter == '√' || letter == '(' => 1,
                _ => return Ok(unit),
            };
            unit = unit.times(self.factor(depth)?, sign);
        }
    }

    fn factor(&mut self, depth: usize) -> Result<Unit, NoUnit> {
        self.skip_blanks();
        let base = self.base(depth)?;
        self.skip_blanks();
        if self.peek() != Some('^') {
            return Ok(base);
        }
        self.at += 1;
        let power = self.power()?;
        base.power(power)
            .ok_or_else(|| no("this power is no simple fraction", "write ^2, ^-1, ^0.5 or ^(1/2)"))
    }

    fn base(&mut self, depth: usize) -> Result<Unit, NoUnit> {
        let root = |unit: Unit| unit.power(0.5).ok_or_else(|| no("this root is no simple fraction", HELP));
        match self.peek() {
            None => Err(no("a unit is missing", HELP)),
            Some('(') => self.bracket(depth),
            Some('√') => {
                self.at += 1;
                let inner = if depth < DEEPEST {
                    self.base(depth + 1)?
                } else {
                    return Err(no("too many roots", HELP));
                };
                root(inner)
            }
            Some(letter) if letter.is_ascii_digit() => Ok(Unit { factor: self.number()?, powers: [0; 3] }),
            Some(_) => {
                let from = self.at;
                while self.peek().is_some_and(|letter| letter.is_alphabetic() || letter == '%') {
                    self.at += 1;
                }
                let word: String = self.letters[from..self.at].iter().collect();
                if word == "sqrt" && self.peek() == Some('(') {
                    return root(self.bracket(depth)?);
                }
                named(&word)
            }
        }
    }

    fn bracket(&mut self, depth: usize) -> Result<Unit, NoUnit> {
        self.at += 1;
        let inner = self.product(depth + 1)?;
        self.skip_blanks();
        if self.peek() != Some(')') {
            return Err(no("a bracket is not closed", HELP));
        }
        self.at += 1;
        Ok(inner)
    }

    fn number(&mut self) -> Result<f64, NoUnit> {
        let from = self.at;
        while self.peek().is_some_and(|letter| letter.is_ascii_digit() || letter == '.') {
            self.at += 1;
        }
        if matches!(self.peek(), Some('e' | 'E')) {
            self.at += 1;
            if matches!(self.peek(), Some('+' | '-')) {
                self.at += 1;
            }
            while self.peek().is_some_and(|letter| letter.is_ascii_digit()) {
                self.at += 1;
            }
        }
        let text: String = self.letters[from..self.at].iter().collect();
        text.parse().map_err(|_| no(&format!("`{text}` is no number"), HELP))
    }

    /// −2, 0.5, (1/2).
    fn power(&mut self) -> Result<f64, NoUnit> {
        let open = self.peek() == Some('(');
        self.at += usize::from(open);
        let minus = self.peek() == Some('-');
        self.at += usize::from(minus);
        let mut power = self.number()?;
        if open && self.peek() == Some('/') {
            self.at += 1;
            power /= self.number()?;
        }
        if open {
            if self.peek() != Some(')') {
                return Err(no("a bracket is not closed", HELP));
            }
            self.at += 1;
        }
        Ok(if minus { -power } else { power })
    }
}

/// A unit by its name, with or without a prefix.
fn named(word: &str) -> Result<Unit, NoUnit> {
    if let Some((_, unit, _)) = NAMES.iter().find(|(name, ..)| *name == word) {
        return Ok(*unit);
    }
    for (prefix, factor) in PREFIXES {
        let rest = word.strip_prefix(prefix);
        let unit = NAMES.iter().find(|(name, _, prefixed)| *prefixed && Some(*name) == rest);
        if let Some((_, unit, _)) = unit {
            return Ok(Unit { factor: unit.factor * factor, ..*unit });
        }
    }
    let help = match crate::input::nearest(word, COMMON) {
        Some(near) => format!("did you mean {near}? {HELP}"),
        None => HELP.to_owned(),
    };
    Err(NoUnit { message: format!("`{word}` is no unit"), help })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn units_are_what_they_say() {
        for (text, si, factor) in [
            ("MPa*sqrt(mm)", "Pa*sqrt(m)", 1e6 * 1e-3_f64.sqrt()),
            ("MPa√m", "Pa m^0.5", 1e6),
            ("MPa.m^(1/2)", "kg/(m^0.5 s^2)", 1e6),
            ("mm/us", "m/s", 1e3),
            ("kg m**-3", "kg/m^3", 1.0),
            ("1/mm", "1/m", 1e3),
            ("rad/us", "1/s", 1e6),
            ("µs", "s", 1e-6),
            ("ksi*sqrt(in)", "Pa*sqrt(m)", 6_894_757.293_168_361 * 0.0254_f64.sqrt()),
            ("%", "1", 0.01),
        ] {
            let (unit, si) = (Unit::parse(text).unwrap(), Unit::parse(si).unwrap());
            assert!(unit.is_like(&si), "{text}");
            assert!((unit.factor / si.factor / factor - 1.0).abs() < 1e-14, "{text}: {}", unit.factor);
        }
        assert!(!Unit::parse("MPa").unwrap().is_like(&Unit::parse("mm").unwrap()));
    }

    #[test]
    fn what_is_none_is_refused_with_the_nearest() {
        assert!(Unit::parse("Mpa").unwrap_err().help.starts_with("did you mean MPa?"));
        for text in ["", "sqrt(m", "m^x", "5)", "m^0.3333", "((((((((((m", "1e999", "*"] {
            assert!(Unit::parse(text).is_err(), "{text}");
        }
    }
}
