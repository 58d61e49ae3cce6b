// Optics against closed forms, published values and the matrix of a thin film (Macleod).
const a0 = snell(0.5, 1, 1.5);                                                                                                       // expect: 0.32532528522279924
const a1 = [snell(0, 1, 1.5), snell(90deg, 1.5, 1), snell(1, 1.3, 1.3)];                                                             // expect: [0, 1.5707963267948966, 1]
const a2 = brewster_angle(1, 1.5);                                                                                                   // expect: 0.982793723247329
const a3 = [critical_angle(1.5, 1), critical_angle(1, 1.5)];                                                                         // expect: [0.7297276562269663, 1.5707963267948966]
const a4 = wien_peak(5772K) * wien_temperature(400nm);                                                                               // expect: 0.003636989909556706
const a5 = planck(wien_peak(5772K), 5772K) > max(planck(1.001 * wien_peak(5772K), 5772K), planck(0.999 * wien_peak(5772K), 5772K));  // expect: true
const a6 = rayleigh(550nm, 1.00027788, 2.54691e25, 0.0284);                                                                          // expect~0.01: 1.162e-5
const a7 = rayleigh(500nm, 1.1, 1e25) / rayleigh(1um, 1.1, 1e25);                                                                    // expect: 16
const a8 = phase_rayleigh(1);                                                                                                        // expect: 0.1193662073189215
const a9 = phase_henyey_greenstein(-1, 0.5);                                                                                         // expect: 0.017683882565766147
const b0 = phase_henyey_greenstein(0.3, 0);                                                                                          // expect: 0.07957747154594767
const b1 = phase_draine(0.3, 0.6, 2);                                                                                                // expect: 0.027995453343866317
const b2 = thin_film_reflectance(550nm, 0.6, 300nm, 1.3, 0.2 + 3.4i);                                                                // expect: 0.9303646142997019
const b3 = thin_film_reflectance(480nm, 0.9, 700nm, 1.33, 1);                                                                        // expect: 0.06075335789973248
const b4 = thin_film_reflectance(480nm, 0.2, 100nm, 1.1, 1, 1.5);                                                                    // expect: 0.9999999999999999
const b5 = thin_film_reflectance(550nm, 0.6, 0, 1.3, 0.2 + 3.4i) / fresnel_conductor(0.6, 0.2, 3.4);                                 // expect: 1
const b6 = thin_film_reflectance(550nm, 0, 100nm, 1.3, 1.5);                                                                         // expect: 1
const b7 = abbe_number(function(l) -> sellmeier(l, 1.03961212, 0.00600069867, 0.231792344, 0.0200179144, 1.01046945, 103.560653));   // expect~1e-3: 64.17
const b8 = abbe_index(587.5618nm, 1.6, 40);                                                                                          // expect: 1.6
const b9 = abbe_number(function(l) -> abbe_index(l, 1.6, 40));                                                                       // expect~1e-5: 40
const c0 = fog_coefficients(10um);                                                                                                   // expect: [0.988176691700256, 0.5556712547839497, 21.995520856274638, 0.4819554318404214]
// A phase function is 1 in all, over the sphere: the midpoint rule over the cosine.
real sphere(function(real) -> real f)
    real upto(integer k, real total) =
        select total, if k == 4000; upto(k + 1, total + f((k + 0.5) / 2000 - 1)) otherwise end;
    return upto(0, 0.0) * tau / 2000;
real d0() = sphere(#phase_rayleigh);                                        // expect~1e-4: 1
real d1() = sphere(function(mu) -> phase_henyey_greenstein(mu, 0.7));       // expect~1e-4: 1
real d2() = sphere(function(mu) -> phase_draine(mu, -0.6, 3.0));            // expect~1e-4: 1
