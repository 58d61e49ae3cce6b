// Strings have double quotes.
surface 'wood' bsdf = matte(0.5); end
//      ^^^^^^ error E0108
