// Illuminants, black bodies and metals come out at their published chromaticities.
real[2] seen(function(real) -> real f) = chromaticity(xyz_of(f));
// CIE 15, table T.3 and T.7 to T.9; sums of 5 nm between 360 and 830 nm are off by up to 3e-4,
// which is 7e-4 of a coordinate.
real[2] a0() = seen(#illuminant_e);                           // expect~3e-4: [0.33333, 0.33333]
real[2] a1() = seen(#illuminant_a);                           // expect~3e-4: [0.44758, 0.40745]
real[2] a2() = seen(#illuminant_d65);                         // expect~3e-4: [0.31272, 0.32903]
real[2] a3() = seen(function(l) -> illuminant_d(l, 5002.8));  // expect~3e-4: [0.34567, 0.35850]
real[2] a4() = seen(function(l) -> illuminant_d(l, 5502.8));  // expect~3e-4: [0.33242, 0.34743]
real[2] a5() = seen(function(l) -> illuminant_d(l, 6503.6));  // expect~3e-4: [0.31272, 0.32903]
real[2] a6() = seen(function(l) -> illuminant_d(l, 7504.2));  // expect~3e-4: [0.29902, 0.31485]
real[2] a7() = seen(function(l) -> illuminant_f(l, 2));       // expect~7e-4: [0.37208, 0.37529]
real[2] a8() = seen(function(l) -> illuminant_f(l, 7));       // expect~7e-4: [0.31292, 0.32933]
real[2] a9() = seen(function(l) -> illuminant_f(l, 11));      // expect~7e-4: [0.38052, 0.37713]
// The Planckian locus (Wyszecki and Stiles 1982, table 1(3.11)): four digits, of an older c2.
real[2] locus(real kelvin) = seen(function(l) -> planck(l, kelvin));
real[2] b0() = locus(1000K);   // expect~5e-4: [0.6528, 0.3444]
real[2] b1() = locus(1500K);   // expect~5e-4: [0.5857, 0.3931]
real[2] b2() = locus(2000K);   // expect~5e-4: [0.5267, 0.4133]
real[2] b3() = locus(2500K);   // expect~5e-4: [0.4770, 0.4137]
real[2] b4() = locus(3000K);   // expect~5e-4: [0.4369, 0.4041]
real[2] b5() = locus(4000K);   // expect~5e-4: [0.3805, 0.3768]
real[2] b6() = locus(5000K);   // expect~5e-4: [0.3451, 0.3516]
real[2] b7() = locus(6500K);   // expect~5e-4: [0.3135, 0.3237]
real[2] b8() = locus(8000K);   // expect~5e-4: [0.2952, 0.3048]
real[2] b9() = locus(10000K);  // expect~5e-4: [0.2807, 0.2884]
// Metals face on under D65, linear sRGB, as usual references print them.
real[3] lit(function(real) -> real f) =
    rgb_of_xyz(xyz_of(function(l) -> f(l) * illuminant_d65(l)) / xyz_of(#illuminant_d65)[1]);
real[3] c0() = lit(function(l) -> fresnel_conductor(1, gold_n(l), gold_k(l)));  // expect~2e-3: [1.022, 0.782, 0.344]
real[3] c1() = lit(function(l) -> fresnel_conductor(1, silver_n(l), silver_k(l)));  // expect~2e-3: [0.972, 0.960, 0.915]
real[3] c2() = lit(function(l) -> fresnel_conductor(1, copper_n(l), copper_k(l)));  // expect~2e-3: [0.955, 0.638, 0.538]
real[3] c3() = lit(#illuminant_e);  // expect~2e-3: [1, 1, 1]
// A reflectance has its luminance in [0, 1] (thesis 4.1), whatever the wavelengths.
real d0() = luminance(rgb(0.3, 0.3, 0.3));     // expect~1e-6: 0.3
logic d1() = 0 < luminance(rgb(1, 0, 0)) < 1;  // expect: true
real d2() = luminance(rgb(1, 0, 0)) + luminance(rgb(0, 1, 0)) + luminance(rgb(0, 0, 1));  // expect~1e-5: 1
// The sun above the air: a black body as large as the sun at one astronomical unit gives 1361 W/m^2.
real total(real nm, sum) = select
    sum, if nm > 100000;
    total(1.02 * nm, sum + planck(nm * 1.01nm, 5772K) * nm * 0.02) otherwise;
end;
real d3() = total(100, 0) * pi * (695700.0 / 149597870.7)^2;  // expect~1e-3: 1361
logic d4() = luminance(sunlight(90deg)) > luminance(sunlight(10deg));  // expect: true
// Measured tables: the ramp through the rows, jumps where two wavelengths are equal.
const real[5] wave = [400nm, 450nm, 520nm, 520nm, 700nm];
const real[5] paint = [0.1, 0.5, 0.2, 0.8, 0.6];
logic same(spectrum s, t) = luminance((s - t)^2) < 1e-12;
logic e0() = same(tabulated(wave, paint), spectral(function(l) -> ramp(l, wave, paint)));  // expect: true
