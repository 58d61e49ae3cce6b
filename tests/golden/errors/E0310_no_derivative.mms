// A height over a function without a rule.
surface s
    height = gold_n($uv.x);
//  ^^^^^^ error E0310: state the `gradient` output
end
surface t
    height = gold_n($uv.x);
    gradient = [0, 0];
end
