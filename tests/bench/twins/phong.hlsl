cbuffer P : register(b0) {
  column_major float4x4 world; column_major float4x4 viewProj; column_major float3x3 nrm; float p;
  float3 eye; float p0;
  float3 ka; float p1; float3 kd; float p2; float3 ks; float shin;
  float3 La; float p3;
  float3 dDir; float p4; float3 dCol; float p5;
  float3 pPos; float p6; float3 pCol; float p7;
  float3 sPos; float sCosOut; float3 sDir; float sScale; float3 sCol; float p8;
};
struct VO { float4 pos:SV_Position; float3 wp:TEXCOORD0; float3 n:TEXCOORD1; };
VO vsmain(float3 aPos:POSITION, float3 aNrm:NORMAL){
  VO o; o.wp=mul(world,float4(aPos,1)).xyz; o.n=mul(nrm,aNrm); o.pos=mul(viewProj,float4(o.wp,1)); return o;
}
float3 unit(float3 v){ return v*rsqrt(max(dot(v,v),1.1754944e-38)); }
float3 shade(float3 n,float3 v,float3 l,float3 L){
  float nl=saturate(dot(n,l));
  float s=nl>0 ? pow(saturate(dot(reflect(-l,n),v)),shin) : 0;
  return (kd*nl+ks*s)*L;
}
float4 main(VO i):SV_Target0 {
  float3 n=unit(i.n), v=normalize(eye-i.wp);
  float3 c=ka*La;
  c+=shade(n,v,-dDir,dCol);
  c+=shade(n,v,normalize(pPos-i.wp),pCol);
  float3 l=normalize(sPos-i.wp);
  c+=shade(n,v,l,sCol*smoothstep(0,1,(dot(sDir,-l)-sCosOut)*sScale));
  return float4(c,1);
}
