// Equal parts of red, green and blue are a grey exactly.
spectrum a() = rgb(0.25, 0.25, 0.25);           // expect: 0.25
spectrum b() = rgb([1, 1, 1]);                  // expect: 1
spectrum c() = rgb(0, 0, 0);                    // expect: 0
