// A source is UTF-8 text.
const a = 1;  ÿ
//            ^ error E0103
