//! The publications that claims cite, as BibTeX. Only what is known for certain is filled in.

/// What a citation contains, and its entry.
const ENTRIES: [(&str, &str); 15] = [
    (
        "Hairer, Nørsett & Wanner 1993",
        "@book{hairernorsettwanner1993,
  author    = {Hairer, Ernst and N{\\o}rsett, Syvert P. and Wanner, Gerhard},
  title     = {Solving Ordinary Differential Equations I: Nonstiff Problems},
  edition   = {2},
  publisher = {Springer},
  year      = {1993}
}
",
    ),
    (
        "Higham & Mary 2019",
        "@article{highammary2019,
  author  = {Higham, Nicholas J. and Mary, Theo},
  title   = {A new approach to probabilistic rounding error analysis},
  journal = {SIAM Journal on Scientific Computing},
  volume  = {41},
  pages   = {A2815--A2835},
  year    = {2019}
}
",
    ),
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
        "Bobaru et al. 2009",
        "@article{bobaru2009,
  author  = {Bobaru, Florin and Yang, Mijia and Alves, Leonardo F. and Silling, Stewart A. and Askari, Ebrahim and Xu, Jifeng},
  title   = {Convergence, adaptive refinement, and scaling in 1D peridynamics},
  journal = {International Journal for Numerical Methods in Engineering},
  volume  = {77},
  pages   = {852--877},
  year    = {2009}
}
",
    ),
    (
        "Seleson 2014",
        "@article{seleson2014,
  author  = {Seleson, Pablo},
  title   = {Improved one-point quadrature algorithms for two-dimensional peridynamic models based on analytical calculations},
  journal = {Computer Methods in Applied Mechanics and Engineering},
  volume  = {282},
  pages   = {184--217},
  year    = {2014}
}
",
    ),
    (
        "Seleson & Littlewood 2016",
        "@article{selesonlittlewood2016,
  author  = {Seleson, Pablo and Littlewood, David J.},
  title   = {Convergence studies in meshfree peridynamic simulations},
  journal = {Computers \\& Mathematics with Applications},
  volume  = {71},
  pages   = {2432--2448},
  year    = {2016}
}
",
    ),
    (
        "Hardy 1915",
        "@article{hardy1915,
  author  = {Hardy, G. H.},
  title   = {On the expression of a number as the sum of two squares},
  journal = {Quarterly Journal of Mathematics},
  volume  = {46},
  pages   = {263--283},
  year    = {1915}
}
",
    ),
    (
        "Le & Bobaru 2018",
        "@article{lebobaru2018,
  author  = {Le, Q. V. and Bobaru, F.},
  title   = {Surface corrections for peridynamic models in elasticity and fracture},
  journal = {Computational Mechanics},
  volume  = {61},
  pages   = {499--518},
  year    = {2018}
}
",
    ),
    (
        "Celik et al. 2008",
        "@article{celik2008,
  author  = {Celik, Ismail B. and Ghia, Urmila and Roache, Patrick J. and Freitas, Christopher J. and Coleman, Hugh and Raad, Peter E.},
  title   = {Procedure for estimation and reporting of uncertainty due to discretization in CFD applications},
  journal = {Journal of Fluids Engineering},
  volume  = {130},
  pages   = {078001},
  year    = {2008}
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
    (
        "Freund 1990",
        "@book{freund1990,
  author    = {Freund, L. B.},
  title     = {Dynamic Fracture Mechanics},
  publisher = {Cambridge University Press},
  year      = {1990}
}
",
    ),
    (
        "Chen 1975",
        "@article{chen1975,
  author  = {Chen, Y. M.},
  title   = {Numerical computation of dynamic stress intensity factors by a Lagrangian finite-difference method (the HEMP code)},
  journal = {Engineering Fracture Mechanics},
  volume  = {7},
  pages   = {653--660},
  year    = {1975}
}
",
    ),
    (
        "Williams 1957",
        "@article{williams1957,
  author  = {Williams, M. L.},
  title   = {On the stress distribution at the base of a stationary crack},
  journal = {Journal of Applied Mechanics},
  volume  = {24},
  pages   = {109--114},
  year    = {1957}
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
