//! The publications that claims cite, as BibTeX. Only what is known for certain is filled in.

/// What a citation contains, and its entry.
const ENTRIES: [(&str, &str); 4] = [
    (
        "Silling 2000",
        "@article{silling2000,
  author  = {Silling, S. A.},
  title   = {Reformulation of elasticity theory for discontinuities and long-range forces},
  journal = {Journal of the Mechanics and Physics of Solids},
  volume  = {48},
  pages   = {175--209},
  year    = {2000}
}
",
    ),
    (
        "Silling & Askari 2005",
        "@article{sillingaskari2005,
  author  = {Silling, S. A. and Askari, E.},
  title   = {A meshfree method based on the peridynamic model of solid mechanics},
  journal = {Computers \\& Structures},
  volume  = {83},
  pages   = {1526--1535},
  year    = {2005}
}
",
    ),
    (
        "Wildman & Gazonas 2014",
        "@article{wildmangazonas2014,
  author  = {Wildman, Raymond A. and Gazonas, George A.},
  title   = {A finite difference-augmented peridynamics method for reducing wave dispersion},
  journal = {International Journal of Fracture},
  volume  = {190},
  pages   = {39--52},
  year    = {2014}
}
",
    ),
    (
        "Bouaraquia",
        "@misc{bouaraquia2024,
  author = {Bouaraquia, O.},
  note   = {Bond-based peridynamics with constant and Gaussian kernels: dispersion, 1D bar, dynamic stress intensity factors},
  year   = {2024}
}
",
    ),
];

/// The entries that a text cites.
pub fn cited_in(text: &str) -> String {
    let found: Vec<&str> =
        ENTRIES.iter().filter(|(mark, _)| text.contains(mark)).map(|(_, entry)| *entry).collect();
    if found.is_empty() { "% derived here; no publication is cited\n".into() } else { found.join("\n") }
}
