// The prelude is there without an import.
const a = mix(1.0, 3.0, 0.5);          // expect: 2
const b = mix([0.0, 1.0], [1.0, 3.0], 0.5);    // expect: [0.5, 2]
const c = saturate(1.5);               // expect: 1
const d = step(0.5, 0.4);              // expect: 0
const e1 = step(0.5, 0.5);             // expect: 1
const f = smoothstep(0, 2, 1);         // expect: 0.5
const g = linearstep(1, 3, 1.5);       // expect: 0.25
const h = pulse(0, 1, 0.5);            // expect: 1
const i = remap(0.5, 0, 1, 10, 20);    // expect: 15
const j = pi;                          // expect: 3.141592653589793
const k = tau / pi;                    // expect: 2
const l = e;                           // expect: 2.718281828459045
const m = bias(0.5, 0.25);             // expect: 0.25
const n = gain(0.25, 0.5);             // expect: 0.25
const o = mod(-1, 3);                  // expect: 2
const p = fmod(-1, 3);                 // expect: -1
const q = mix(spectrum(0), spectrum(1), 0.25);   // expect: 0.25
