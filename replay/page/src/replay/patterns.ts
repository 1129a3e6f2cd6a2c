/** Steps to begin with, for people who write them by hand. */
export const patterns: readonly [string, string][] = [
  ["simplex", '{"op":"simplex","name":"T","dim":2}'],
  ["square", '{"op":"simploid","name":"Q","type":[1,1]}'],
  ["cone over a body", '{"op":"cone","apex":"v","over":"T"}'],
  ["suspension of a body", '{"op":"suspend","apexes":["n","s"],"over":"T"}'],
  ["glue cells", '{"op":"identify","pairs":[["T.0-1","T.0-2"]]}'],
  ["split a cell", '{"op":"deidentify","split":[{"cell":"T.0","as":"w","moves":[["T.0-1",0]]}]}'],
  ["squash a cell", '{"op":"degenerate","cell":"T","along":0}'],
  ["product of bodies", '{"op":"product","name":"P","left":"A","right":"B"}'],
  ["add simplices on labels", '{"op":"insert","simplices":[["a","b"],["b","c"],["a","c"]]}'],
  ["collapse a label", '{"op":"collapse","from":"a","to":"b"}'],
  ["flip an edge", '{"op":"replace","flip":"{a,b}"}'],
  ["ask for a class", '{"op":"class","chain":[[1,"T.0-1"],[1,"T.1-2"],[-1,"T.0-2"]]}'],
];
