/// The numbers of a line in order: parted by blanks, tabs, commas or semicolons, or run together where a sign or a point
/// shows that the next one begins; with exponents of E, D or Q, or as Fortran writes them when they have three digits
/// (`0.1-101`) or a blank for the plus (`1.0E 02`).
pub struct Numbers<'a> {
    text: &'a str,
    at: usize,
}

impl<'a> Numbers<'a> {
    /// Of this line.
    pub fn of(text: &'a str) -> Numbers<'a> {
        Numbers { text, at: 0 }
    }

    fn byte(&self, at: usize) -> u8 {
        self.text.as_bytes().get(at).copied().unwrap_or(b' ')
    }

    fn after_digits(&self, mut at: usize) -> usize {
        while self.byte(at).is_ascii_digit() {
            at += 1;
        }
        at
    }

    /// Where the mantissa that begins here ends, if one does.
    fn mantissa_end(&self, start: usize) -> Option<usize> {
        let digits = start + usize::from(is_sign(self.byte(start)));
        let whole_end = self.after_digits(digits);
        let has_point = self.byte(whole_end) == b'.';
        let end = if has_point { self.after_digits(whole_end + 1) } else { whole_end };
        (end - digits > usize::from(has_point)).then_some(end)
    }

    /// The exponent that begins here: where its digits start, and where they end.
    fn exponent(&self, at: usize) -> Option<(usize, usize)> {
        let letter = matches!(self.byte(at), b'e' | b'E' | b'd' | b'D' | b'q' | b'Q');
        let signed = at + usize::from(letter);
        let blank_for_plus = letter && self.byte(signed) == b' ';
        let digits = signed + usize::from(is_sign(self.byte(signed)) || blank_for_plus);
        let end = self.after_digits(digits);
        let complete = if letter {
            end > digits
        } else {
            // Without a letter only three digits make an exponent: anything else is the next number.
            digits > signed && end - digits == 3 && self.byte(end) != b'.'
        };
        let start = if blank_for_plus { digits } else { signed };
        complete.then_some((start, end))
    }

    fn value(&self, start: usize, mantissa_end: usize, exponent: Option<(usize, usize)>) -> Option<f64> {
        let mantissa = self.text.get(start..mantissa_end)?;
        let value = match exponent {
            None => mantissa.parse(),
            Some((from, to)) => format!("{mantissa}e{}", self.text.get(from..to)?).parse(),
        };
        value.ok().filter(|value: &f64| value.is_finite())
    }

    /// What stands here up to the next separator, for a message.
    fn word(&self, start: usize) -> &'a str {
        let rest = self.text.get(start..).unwrap_or("");
        rest.split(|c: char| c.is_ascii() && is_separator(c as u8)).next().unwrap_or(rest)
    }
}

impl<'a> Iterator for Numbers<'a> {
    /// A finite number, or the text that is none.
    type Item = Result<f64, &'a str>;

    fn next(&mut self) -> Option<Result<f64, &'a str>> {
        while self.at < self.text.len() && is_separator(self.byte(self.at)) {
            self.at += 1;
        }
        if self.at >= self.text.len() {
            return None;
        }
        let start = self.at;
        let read = self.mantissa_end(start).and_then(|mantissa_end| {
            let exponent = self.exponent(mantissa_end);
            let end = exponent.map_or(mantissa_end, |(_, end)| end);
            let next = self.byte(end);
            let ends_here = is_separator(next) || is_sign(next) || next == b'.';
            let value = if ends_here { self.value(start, mantissa_end, exponent) } else { None };
            value.map(|value| (value, end))
        });
        match read {
            Some((value, end)) => {
                self.at = end;
                Some(Ok(value))
            }
            None => {
                let word = self.word(start);
                self.at = start + word.len().max(1);
                Some(Err(word))
            }
        }
    }
}

/// The first number in a text, whatever stands before it.
pub fn first_number(text: &str) -> Option<f64> {
    let starts = |c: char| c.is_ascii_digit() || matches!(c, '+' | '-' | '.');
    text.match_indices(starts).find_map(|(at, _)| leading_number(text.get(at..)?))
}

/// The number with which a text begins, though letters may follow it at once (`100Hz`).
pub fn leading_number(text: &str) -> Option<f64> {
    let numbers = Numbers::of(text.trim_start());
    let mantissa_end = numbers.mantissa_end(0)?;
    numbers.value(0, mantissa_end, numbers.exponent(mantissa_end))
}

fn is_sign(byte: u8) -> bool {
    matches!(byte, b'+' | b'-')
}

fn is_separator(byte: u8) -> bool {
    // Form feeds and the end-of-file mark of old systems stand in real files.
    matches!(byte, b' ' | b'\t' | b',' | b';' | b'\r' | b'\x0c' | b'\x1a' | b'\0')
}
