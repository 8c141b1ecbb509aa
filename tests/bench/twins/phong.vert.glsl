#version 450
layout(location=0) in vec3 aPos; layout(location=1) in vec3 aNrm;
layout(location=0) out vec3 vPos; layout(location=1) out vec3 vNrm;
layout(std140,set=0,binding=0) uniform P {
  mat4 world; mat4 viewProj; mat3 nrm; vec3 eye; float p0;
  vec3 ka; float p1; vec3 kd; float p2; vec3 ks; float shin;
  vec3 La; float p3;
  vec3 dDir; float p4; vec3 dCol; float p5;
  vec3 pPos; float p6; vec3 pCol; float p7;
  vec3 sPos; float sCosOut; vec3 sDir; float sScale; vec3 sCol; float p8;
};
void main(){
  vPos=(world*vec4(aPos,1.0)).xyz; vNrm=nrm*aNrm;
  gl_Position=viewProj*vec4(vPos,1.0);
}
