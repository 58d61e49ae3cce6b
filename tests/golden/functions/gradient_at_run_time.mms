// At the hit: the derivative is computed there.
real slope() = gradient(function(x) -> x * x, $uv.x + 1.0) / ($uv.x + 1.0);      // expect: 2
real[2] both() = gradient(function(q) -> q.x * q.y, $uv) - [$uv.y, $uv.x];       // expect: [0, 0]
