//! How many threads and how much memory this machine will give: what is free, what its control group may hold, what the shell allows.

use std::fs;

/// Bytes that may be taken, and who says so.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Room {
    pub bytes: f64,
    pub of: &'static str,
}

/// Where nothing is known: more than any one machine has.
const UNKNOWN: Room = Room { bytes: (1_u64 << 42) as f64, of: "the most that any run is given" };

/// The least of all that is known.
pub fn room() -> Room {
    let said = [
        (free(), "free on this machine"),
        (control_group(), "left to its control group"),
        (address_space(), "left of the address space that this process may have (ulimit -v)"),
    ];
    let known = said.into_iter().filter_map(|(bytes, of)| Some(Room { bytes: bytes?, of }));
    known.fold(UNKNOWN, |least, room| if room.bytes < least.bytes { room } else { least })
}

/// Threads that are asked for, or as many as there are.
pub fn threads(asked: Option<u16>) -> usize {
    asked.map_or_else(|| std::thread::available_parallelism().map_or(1, usize::from), usize::from)
}

/// Bytes that Linux can give without swapping; `None` where nothing is known.
pub fn free() -> Option<f64> {
    amount(&fs::read_to_string("/proc/meminfo").ok()?, "MemAvailable:")
}

/// The number of a line such as `MemAvailable:   24 kB`, in bytes.
fn amount(text: &str, name: &str) -> Option<f64> {
    let line = text.lines().find_map(|line| line.strip_prefix(name))?;
    let kibibytes: f64 = line.trim().strip_suffix("kB")?.trim().parse().ok()?;
    Some(1024.0 * kibibytes)
}

/// What the control group of this process may hold beyond what it holds; pages of files give way, so they do not count.
fn control_group() -> Option<f64> {
    let text = fs::read_to_string("/proc/self/cgroup").ok()?;
    let own = text.lines().find_map(|line| line.strip_prefix("0::")).unwrap_or("/");
    let unified = format!("/sys/fs/cgroup{}", own.trim_end_matches('/'));
    let places = [
        (unified.as_str(), "memory.max", "anon "),
        ("/sys/fs/cgroup", "memory.max", "anon "),
        ("/sys/fs/cgroup/memory", "memory.limit_in_bytes", "rss "),
    ];
    let left = |(folder, limit, held): (&str, &str, &str)| {
        let most: f64 = fs::read_to_string(format!("{folder}/{limit}")).ok()?.trim().parse().ok()?;
        let counts = fs::read_to_string(format!("{folder}/memory.stat")).ok()?;
        let held: f64 = counts.lines().find_map(|line| line.strip_prefix(held))?.trim().parse().ok()?;
        Some((most - held).max(0.0))
    };
    places.into_iter().filter_map(left).reduce(f64::min)
}

/// What is left of the limit on addresses, where there is one.
fn address_space() -> Option<f64> {
    let limit = soft_limit(&fs::read_to_string("/proc/self/limits").ok()?, "Max address space")?;
    let taken = amount(&fs::read_to_string("/proc/self/status").ok()?, "VmSize:")?;
    Some((limit - taken).max(0.0))
}

/// The first number of a row of `/proc/self/limits`; `None` where it says `unlimited`.
fn soft_limit(limits: &str, name: &str) -> Option<f64> {
    limits.lines().find_map(|line| line.strip_prefix(name))?.split_whitespace().next()?.parse().ok()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_free_is_read_and_what_is_unknown_is_not_zero() {
        let free = |text| amount(text, "MemAvailable:");
        assert_eq!(free("MemTotal:  9 kB\nMemAvailable:   24 kB\n"), Some(24.0 * 1024.0));
        assert_eq!(free("MemTotal:  9 kB\n"), None);
        assert_eq!(free("MemAvailable:  many\n"), None);
    }

    #[test]
    fn a_limit_is_the_soft_one_and_unlimited_is_none() {
        let limits = "Limit                     Soft Limit           Hard Limit           Units\n\
                      Max address space         3000000              9000000              bytes\n\
                      Max data size             unlimited            unlimited            bytes\n";
        assert_eq!(soft_limit(limits, "Max address space"), Some(3e6));
        assert_eq!(soft_limit(limits, "Max data size"), None);
    }

    #[test]
    fn there_is_room_and_somebody_who_says_so() {
        let room = room();
        assert!(room.bytes > 0.0 && room.bytes <= UNKNOWN.bytes && !room.of.is_empty(), "{room:?}");
    }
}
