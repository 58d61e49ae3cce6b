// A material has 64 models and combiners at most.
material pile(integer n) = select matte(0.5), if n == 0; mix(pile(n - 1), matte(0.5), 0.5) otherwise end;
surface s
    bsdf = pile(40);
//  ^^^^ error E0302: 81
end
surface t
    bsdf = pile(31);
end
