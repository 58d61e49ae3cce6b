// A choice is differentiated arm by arm.
surface s
    height = select $position.x ^ 3, if $position.x > 0; sin($position.y) otherwise end;
end
// check-gradient: surface s
