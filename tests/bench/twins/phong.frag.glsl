#version 450
layout(location=0) in vec3 vPos; layout(location=1) in vec3 vNrm;
layout(location=0) out vec4 oCol;
layout(std140,set=0,binding=0) uniform P {
  mat4 world; mat4 viewProj; mat3 nrm; vec3 eye; float p0;
  vec3 ka; float p1; vec3 kd; float p2; vec3 ks; float shin;
  vec3 La; float p3;
  vec3 dDir; float p4; vec3 dCol; float p5;
  vec3 pPos; float p6; vec3 pCol; float p7;
  vec3 sPos; float sCosOut; vec3 sDir; float sScale; vec3 sCol; float p8;
};
vec3 unit(vec3 v){ return v*inversesqrt(max(dot(v,v),1.1754944e-38)); }
vec3 shade(vec3 n, vec3 v, vec3 l, vec3 L){
  float nl=dot(n,l), s=0.0;
  if (nl>0.0) s=pow(clamp(dot(reflect(-l,n),v),0.0,1.0),shin);
  return (kd*clamp(nl,0.0,1.0)+ks*s)*L;
}
void main(){
  vec3 n=unit(vNrm), v=normalize(eye-vPos);
  vec3 c=ka*La;
  c+=shade(n,v,-dDir,dCol);
  c+=shade(n,v,normalize(pPos-vPos),pCol);
  vec3 l=normalize(sPos-vPos);
  c+=shade(n,v,l,sCol*smoothstep(0.0,1.0,(dot(sDir,-l)-sCosOut)*sScale));
  oCol=vec4(c,1.0);
}
