// An unused name near an output's is a slip.
surface s
    heigth = 0.5 * $uv.x;
//  ^^^^^^ error E0217: did you mean `height`?
end
volume v
    scatering = 1;
//  ^^^^^^^^^ error E0217: volume
end
