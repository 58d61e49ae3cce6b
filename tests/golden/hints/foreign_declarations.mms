// No word begins a definition.
surface s
    let x = 1;
//  ^^^ error E0149: there is no type `let`
    var y = 2;
//  ^^^ error E0149: there is no type `var`
    bsdf = matte(x + y);
end
