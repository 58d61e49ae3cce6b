// 50% is 0.5.
const a = 50%;
//          ^ error E0144: write `0.5`
