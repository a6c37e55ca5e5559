// Prints open_pbr.json with the headers of github.com/adobe/openpbr-bsdf at a29da96 and glm:
// g++ -std=c++17 -I openpbr-bsdf open_pbr.cpp
#include <glm/glm.hpp>
#include "openpbr.h"
#include <cstdio>
#include <cmath>
static unsigned s=1; static float rnd(){ s=s*1664525u+1013904223u; return (s>>8)*0x1.0p-24f; }
static vec3 dir(){ float z=0.05f+0.95f*rnd(), t=6.2831853f*rnd(), r=sqrtf(1-z*z); return normalize(vec3(r*cosf(t),r*sinf(t),z)); }
static void v3(vec3 v){ printf("[%.9g, %.9g, %.9g]", v.x,v.y,v.z); }
int main(){
  printf("{\n\"metal\": [\n");
  for(int i=0;i<96;i++){
    float r=0.2f+0.8f*rnd(), a= i%3==0?0.0f:rnd()*0.9f;
    vec3 f0(rnd(),rnd(),rnd()), tint = i%4==0?vec3(1.0f):vec3(rnd(),rnd(),rnd());
    vec3 wo=dir(), wi=dir();
    vec2 alpha=openpbr_compute_anisotropic_alpha(r*r,a,false,1e-6f);
    vec3 h=normalize(wo+wi);
    float c=dot(wo,h);
    vec3 F=openpbr_metal_schlick_with_f82_tint(f0,tint,c);
    float D=openpbr_eval_aniso_ggx(h,alpha), G=openpbr_eval_aniso_smith_g2(wo,wi,alpha);
    vec3 f=F*(D*G/(4*wo.z*wi.z));
    printf("  {\"roughness\": %.9g, \"anisotropy\": %.9g, \"f0\": ",r,a); v3(f0); printf(", \"tint\": "); v3(tint);
    printf(", \"wo\": "); v3(wo); printf(", \"wi\": "); v3(wi); printf(", \"f\": "); v3(f); printf("}%s\n", i<95?",":"");
  }
  printf("],\n\"diffuse\": [\n");
  for(int i=0;i<48;i++){
    float r=rnd(); vec3 rho(rnd(),rnd(),rnd()), wo=dir(), wi=dir();
    vec3 f=openpbr_f_EON(rho,r,wo,wi,true);
    printf("  {\"roughness\": %.9g, \"albedo\": ",r); v3(rho); printf(", \"wo\": "); v3(wo); printf(", \"wi\": "); v3(wi); printf(", \"f\": "); v3(f); printf("}%s\n", i<47?",":"");
  }
  printf("],\n\"darkening\": [\n");
  for(int i=0;i<32;i++){
    OpenPBR_ResolvedInputs in=openpbr_make_default_resolved_inputs();
    in.coat_weight=1.0f; in.coat_ior=1.2f+0.8f*rnd(); in.coat_roughness=0.0f; in.specular_roughness=0.3f+0.7f*rnd(); in.specular_ior=1.8f+rnd();
    in.base_color=vec3(rnd(),rnd(),rnd());
    vec3 wo=dir(), wi=dir(); vec3 d[2];
    for(int k=0;k<2;k++){ in.coat_darkening=float(k);
      auto p=openpbr_prepare(in,vec3(1.0f),OpenPBR_BaseRgbWavelengths_nm,OpenPBR_VacuumIor,wo);
      d[k]=openpbr_eval(p,wi).diffuse; }
    vec3 delta=d[1]/d[0];
    printf("  {\"coat_ior\": %.9g, \"specular_ior\": %.9g, \"roughness\": %.9g, \"base_color\": ",in.coat_ior,in.specular_ior,in.specular_roughness); v3(in.base_color); printf(", \"delta\": "); v3(delta); printf("}%s\n", i<31?",":"");
  }
  printf("]\n}\n");
}
