struct P {
  world: mat4x4f, viewProj: mat4x4f, nrm: mat3x3f, eye: vec3f, p0: f32,
  ka: vec3f, p1: f32, kd: vec3f, p2: f32, ks: vec3f, shin: f32,
  La: vec3f, p3: f32,
  dDir: vec3f, p4: f32, dCol: vec3f, p5: f32,
  pPos: vec3f, p6: f32, pCol: vec3f, p7: f32,
  sPos: vec3f, sCosOut: f32, sDir: vec3f, sScale: f32, sCol: vec3f, p8: f32,
}
@group(0) @binding(0) var<uniform> u: P;
struct VO { @builtin(position) pos: vec4f, @location(0) wp: vec3f, @location(1) n: vec3f }
@vertex fn vsmain(@location(0) aPos: vec3f, @location(1) aNrm: vec3f) -> VO {
  let wp = (u.world*vec4f(aPos,1.0)).xyz;
  return VO(u.viewProj*vec4f(wp,1.0), wp, u.nrm*aNrm);
}
fn unit(v: vec3f) -> vec3f { return v*inverseSqrt(max(dot(v,v),1.1754944e-38)); }
fn shade(n: vec3f, v: vec3f, l: vec3f, L: vec3f) -> vec3f {
  let nl = saturate(dot(n,l));
  let s = select(0.0, pow(saturate(dot(reflect(-l,n),v)),u.shin), nl > 0.0);
  return (u.kd*nl+u.ks*s)*L;
}
@fragment fn fsmain(@location(0) wp: vec3f, @location(1) nrm: vec3f) -> @location(0) vec4f {
  let n = unit(nrm); let v = normalize(u.eye-wp);
  var c = u.ka*u.La;
  c += shade(n,v,-u.dDir,u.dCol);
  c += shade(n,v,normalize(u.pPos-wp),u.pCol);
  let l = normalize(u.sPos-wp);
  c += shade(n,v,l,u.sCol*smoothstep(0.0,1.0,(dot(u.sDir,-l)-u.sCosOut)*u.sScale));
  return vec4f(c,1.0);
}
