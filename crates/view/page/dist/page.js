function kf(i){if(i.byteLength<16)return null;let e=new DataView(i),t=e.getUint32(4,!0),n=e.getFloat64(8,!0);switch(e.getUint8(0)){case 1:return Tv(i,e.getUint8(1),t,n);case 2:return i.byteLength<16+12*t?null:{kind:"values",values:{time:n,values:new Float64Array(i,16,t),ids:new Uint32Array(i,16+8*t,t)}};default:return null}}function Tv(i,e,t,n){let s=(e&1)!==0,r=(e&2)!==0,o=16+12*t+(s?12*t:0)+(r?4*t:0)+8*t;if(i.byteLength<o)return null;let a=16,l=d=>{let f=new Float32Array(i,a,d);return a+=4*d,f},c=l(3*t),h=s?l(3*t):null,u=r?l(t):null;return{kind:"frame",frame:{time:n,n:t,positions:c,velocities:h,values:u,attitudes:new Int16Array(i,a,4*t)}}}var Tt=class{constructor(e){this.current=e}current;listeners=new Set;get value(){return this.current}set value(e){if(Object.is(e,this.current))return;let t=this.current;this.current=e;for(let n of[...this.listeners])n(e,t)}on(e){return this.listeners.add(e),()=>this.listeners.delete(e)}now(e){return e(this.current,this.current),this.on(e)}};function Ui(i,e){let t=-1/0,n;return()=>{if(n!==void 0)return;let s=t+i-performance.now(),r=()=>{n=void 0,t=performance.now(),e()};s<=0?r():n=setTimeout(r,s)}}var eu=500,Av=5e3;function zf(i){let e=new URL("stream",i.href);return e.protocol=i.protocol==="https:"?"wss:":"ws:",e.search=i.search,e.hash="",e.href}var Za=class{constructor(e,t){this.address=e;this.listener=t;this.open(),addEventListener("online",()=>this.retry()),document.addEventListener("visibilitychange",()=>{document.hidden||this.retry()})}address;listener;link=new Tt("connecting");socket=null;wait_ms=eu;timer;send(e){return this.socket?.readyState!==WebSocket.OPEN?!1:(this.socket.send(JSON.stringify(e)),!0)}retry(){this.link.value==="lost"&&(clearTimeout(this.timer),this.wait_ms=eu,this.open())}open(){clearTimeout(this.timer);let e=new WebSocket(this.address);e.binaryType="arraybuffer",this.socket=e,e.addEventListener("open",()=>{this.wait_ms=eu,this.link.value="open"}),e.addEventListener("message",t=>this.hear(t.data)),e.addEventListener("close",()=>{this.socket===e&&(this.socket=null,this.link.value="lost",this.timer=setTimeout(()=>this.open(),this.wait_ms),this.wait_ms=Math.min(2*this.wait_ms,Av))})}hear(e){if(typeof e=="string"){let n;try{n=JSON.parse(e)}catch{this.listener.garbled("The program sent a message that is no JSON.");return}this.listener.message(n);return}let t=kf(e);t===null?this.listener.garbled("The program sent a binary message that this page does not know."):t.kind==="frame"?this.listener.frame(t.frame):this.listener.values(t.values)}};function B(i,e={},...t){let n=document.createElement(i);for(let[s,r]of Object.entries(e))if(!(r==null||r===!1))if(s==="text")n.textContent=String(r);else if(s==="on")for(let[o,a]of Object.entries(r))n.addEventListener(o,a);else n.setAttribute(s,r===!0?"":String(r));return n.append(...t.filter(s=>!!s)),n}function at(i,e){i.textContent!==e&&(i.textContent=e)}function et(i,e){i.hidden===e&&(i.hidden=!e)}var Rv="http://www.w3.org/2000/svg";function tu(i,e){let t=document.createElementNS(Rv,i);for(let[n,s]of Object.entries(e))t.setAttribute(n,String(s));return t}function ut(i,e,t,n,s={}){return B("button",{type:"button",title:e?`${i} (${e})`:i,"aria-label":i,"aria-keyshortcuts":e??void 0,on:{click:n},...s},t)}var Hs=["labels","trails","links","packets","beams","wind","grid","world"],Cv=["kind","battery","speed","value"],Pv=["auto","light","dark"];function Vf(i){let e=new URLSearchParams;if(i.t_s!==void 0&&e.set("t",String(Hf(i.t_s,9))),i.select!==void 0&&e.set("select",i.select),i.follow&&e.set("follow","1"),i.camera){let{from:t,at:n,flat:s}=i.camera;e.set("camera",[...t,...n].map(r=>Hf(r,3)).join(",")+(s?",flat":""))}if(i.layers){let t=i.layers;e.set("layers",Hs.filter(n=>t[n]).join(","))}return i.colour&&e.set("colour",i.colour.by==="value"?`value:${i.colour.name}`:i.colour.by),i.theme&&e.set("theme",i.theme),i.charts&&e.set("charts",i.charts.map(t=>(t.own?"own:":"")+t.name).join(",")),i.panels&&e.set("panels",i.panels.join(",")),e.toString().replaceAll("%2C",",").replaceAll("%3A",":").replaceAll("%2F","/")}function Ka(i){let e=new URLSearchParams(i.replace(/^#/,"")),t={},n=e.get("t");n!==null&&n!==""&&Number.isFinite(Number(n))&&(t.t_s=Number(n));let s=e.get("select");s&&(t.select=s),e.has("follow")&&(t.follow=e.get("follow")==="1");let r=e.get("camera")?.split(",");if(r){let u=r.slice(0,6).map(Number);u.length===6&&u.every(Number.isFinite)&&(t.camera={from:[u[0],u[1],u[2]],at:[u[3],u[4],u[5]],flat:r[6]==="flat"})}let o=e.get("layers")?.split(",");o&&(t.layers=Object.fromEntries(Hs.map(u=>[u,o.includes(u)])));let a=e.get("colour");a?.startsWith("value:")?t.colour={by:"value",name:a.slice(6)}:a&&Cv.includes(a)&&(t.colour={by:a,name:""});let l=e.get("theme");l&&Pv.includes(l)&&(t.theme=l);let c=e.get("charts");c!==null&&(t.charts=c.split(",").filter(u=>u!=="").map(u=>u.startsWith("own:")?{name:u.slice(4),own:!0}:{name:u,own:!1}));let h=e.get("panels");return h!==null&&(t.panels=h.split(",").filter(u=>u!=="")),t}function Hf(i,e){return Number(i.toFixed(e))}function Gf(i){try{return localStorage.getItem(`simbeeotic.${i}`)}catch{return null}}function Wf(i,e){try{localStorage.setItem(`simbeeotic.${i}`,e)}catch{}}var Ja=class{theme;large;dark;system=matchMedia("(prefers-color-scheme: dark)");constructor(){let e=Gf("theme");this.theme=new Tt(e==="light"||e==="dark"?e:"auto"),this.large=new Tt(Gf("text")==="large"),this.dark=new Tt(this.isDark());let t=()=>{this.dark.value=this.isDark(),document.documentElement.dataset.theme=this.dark.value?"dark":"light",document.documentElement.dataset.text=this.large.value?"large":"normal"};t(),this.system.addEventListener("change",t),this.theme.on(n=>{Wf("theme",n),t()}),this.large.on(n=>{Wf("text",n?"large":"normal"),t()})}nextTheme(){this.theme.value={auto:"light",light:"dark",dark:"auto"}[this.theme.value]}isDark(){return this.theme.value==="dark"||this.theme.value==="auto"&&this.system.matches}};function hi(i,e=3){if(i==null||!Number.isFinite(i))return"–";let t=Math.abs(i),n=i<0?"−":"";if(t===0)return"0";if(t>=1e15||t<1e-4)return n+t.toExponential(e-1).replace("-","−");for(let[r,o]of[[1e12,"T"],[1e9,"G"],[1e6,"M"]])if(t>=r)return`${n}${(t/r).toPrecision(e)} ${o}`;if(t>=1e3)return n+Math.round(t).toLocaleString("en").replaceAll(","," ");let s=Math.max(0,e-1-Math.floor(Math.log10(t)));return n+t.toFixed(Math.min(s,6))}function Qn(i,e){if(i==null||!Number.isFinite(i))return"–";let t=Math.abs(i).toFixed(e);return i<0&&Number(t)!==0?"−"+t:t}function Ai(i){return Math.round(i).toLocaleString("en").replaceAll(","," ")}function Pn(i,e=2){if(!Number.isFinite(i))return"–";let t=10**e,n=Math.floor(Math.abs(i)*t+1e-6),s=Math.floor(n/t),r=e?`.${String(n%t).padStart(e,"0")}`:"",o=i<0&&n>0?"−":"";if(s<60)return`${o}${s}${r} s`;let a=c=>String(c).padStart(2,"0"),l=Math.floor(s/60);return l<60?`${o}${l}:${a(s%60)}${r}`:`${o}${Math.floor(l/60)}:${a(l%60)}:${a(s%60)}${r}`}function Vs(i){return`${hi(i,i>=10?2:3).replace(/(\.\d*?)0+$/,"$1").replace(/\.$/,"")} ×`}function ja(i){return i===""||i==="1"?"":` ${i}`}function Gs(i){return i.replaceAll("/"," ").replaceAll("_"," ")}/**
 * @license
 * Copyright 2010-2026 Three.js Authors
 * SPDX-License-Identifier: MIT
 */var yp=0,Iu=1,bp=2;var ga=1,Sp=2,vo=3,ss=0,Jn=1,ln=2,br=0,ir=1,va=2,Lu=3,Du=4,Mp=5;var Sr=100,wp=101,Ep=102,Tp=103,Ap=104,Rp=200,Cp=201,Pp=202,Ip=203,Nu=204,Fu=205,Lp=206,Dp=207,Np=208,Fp=209,Up=210,Op=211,Bp=212,kp=213,zp=214,Tl=0,Al=1,Rl=2,oo=3,Cl=4,Pl=5,Il=6,Ll=7,Uu=0,Hp=1,Vp=2,rs=0,Ou=1,Bu=2,ku=3,zu=4,Hu=5,Vu=6,Gu=7;var Wu=300,Mr=301,_o=302,sc=303,rc=304,Ks=1e3,ts=1001,Dl=1002,an=1003,Gp=1004;var _a=1005;var Fn=1006,oc=1007;var vi=1008;var _i=1009,Xu=1010,xa=1011,xo=1012,ac=1013,xi=1014,ti=1015,Vi=1016,lc=1017,cc=1018,wr=1020,qu=35902,Yu=35899,$u=1021,Zu=1022,yi=1023,Ss=1026,As=1027,hc=1028,uc=1029,sr=1030,dc=1031;var yo=1033,ya=33776,ba=33777,Sa=33778,Ma=33779,fc=35840,pc=35841,mc=35842,gc=35843,vc=36196,_c=37492,xc=37496,yc=37488,bc=37489,wa=37490,Sc=37491,Mc=37808,wc=37809,Ec=37810,Tc=37811,Ac=37812,Rc=37813,Cc=37814,Pc=37815,Ic=37816,Lc=37817,Dc=37818,Nc=37819,Fc=37820,Uc=37821,Oc=36492,Bc=36494,kc=36495,zc=36283,Hc=36284,Ea=36285,Vc=36286;var Qo=2300,Nl=2301,wl=2302,wu=2303,Eu=2400,Tu=2401,Au=2402;var Wp=3200;var Ku=0,Xp=1,Rs="",fi="srgb",mr="srgb-linear",ea="linear",Pt="srgb";var El=7680;var qp=519,Yp=512,$p=513,Zp=514,Ju=515,Kp=516,Jp=517,ju=518,Qu=519,jp=35044,Gc=35048;var ed="300 es",Ci=2e3,ta=2001;function Iv(i){for(let e=i.length-1;e>=0;--e)if(i[e]>=65535)return!0;return!1}function Lv(i){return ArrayBuffer.isView(i)&&!(i instanceof DataView)}function na(i){return document.createElementNS("http://www.w3.org/1999/xhtml",i)}function Qp(){let i=na("canvas");return i.style.display="block",i}var Xf={},ao=null;function td(...i){let e="THREE."+i.shift();ao?ao("log",e,...i):console.log(e,...i)}function em(i){let e=i[0];if(typeof e=="string"&&e.startsWith("TSL:")){let t=i[1];t&&t.isStackTrace?i[0]+=" "+t.getLocation():i[1]='Stack trace not available. Enable "THREE.Node.captureStackTrace" to capture stack traces.'}return i}function $e(...i){i=em(i);let e="THREE."+i.shift();if(ao)ao("warn",e,...i);else{let t=i[0];t&&t.isStackTrace?console.warn(t.getError(e)):console.warn(e,...i)}}function Qe(...i){i=em(i);let e="THREE."+i.shift();if(ao)ao("error",e,...i);else{let t=i[0];t&&t.isStackTrace?console.error(t.getError(e)):console.error(e,...i)}}function jo(...i){let e=i.join(" ");e in Xf||(Xf[e]=!0,$e(...i))}function tm(i,e,t){return new Promise(function(n,s){function r(){switch(i.clientWaitSync(e,i.SYNC_FLUSH_COMMANDS_BIT,0)){case i.WAIT_FAILED:s();break;case i.TIMEOUT_EXPIRED:setTimeout(r,t);break;default:n()}}setTimeout(r,t)})}var nm={[Tl]:Tl,[Rl]:Il,[Cl]:Cl,[oo]:Pl,[Al]:Al,[Il]:Rl,[Ll]:Ll,[Pl]:oo},ns=class{addEventListener(e,t){this._listeners===void 0&&(this._listeners={});let n=this._listeners;n[e]===void 0&&(n[e]=[]),n[e].indexOf(t)===-1&&n[e].push(t)}hasEventListener(e,t){let n=this._listeners;return n===void 0?!1:n[e]!==void 0&&n[e].indexOf(t)!==-1}removeEventListener(e,t){let n=this._listeners;if(n===void 0)return;let s=n[e];if(s!==void 0){let r=s.indexOf(t);r!==-1&&s.splice(r,1)}}dispatchEvent(e){let t=this._listeners;if(t===void 0)return;let n=t[e.type];if(n!==void 0){e.target=this;let s=n.slice(0);for(let r=0,o=s.length;r<o;r++)s[r].call(this,e);e.target=null}}},kn=["00","01","02","03","04","05","06","07","08","09","0a","0b","0c","0d","0e","0f","10","11","12","13","14","15","16","17","18","19","1a","1b","1c","1d","1e","1f","20","21","22","23","24","25","26","27","28","29","2a","2b","2c","2d","2e","2f","30","31","32","33","34","35","36","37","38","39","3a","3b","3c","3d","3e","3f","40","41","42","43","44","45","46","47","48","49","4a","4b","4c","4d","4e","4f","50","51","52","53","54","55","56","57","58","59","5a","5b","5c","5d","5e","5f","60","61","62","63","64","65","66","67","68","69","6a","6b","6c","6d","6e","6f","70","71","72","73","74","75","76","77","78","79","7a","7b","7c","7d","7e","7f","80","81","82","83","84","85","86","87","88","89","8a","8b","8c","8d","8e","8f","90","91","92","93","94","95","96","97","98","99","9a","9b","9c","9d","9e","9f","a0","a1","a2","a3","a4","a5","a6","a7","a8","a9","aa","ab","ac","ad","ae","af","b0","b1","b2","b3","b4","b5","b6","b7","b8","b9","ba","bb","bc","bd","be","bf","c0","c1","c2","c3","c4","c5","c6","c7","c8","c9","ca","cb","cc","cd","ce","cf","d0","d1","d2","d3","d4","d5","d6","d7","d8","d9","da","db","dc","dd","de","df","e0","e1","e2","e3","e4","e5","e6","e7","e8","e9","ea","eb","ec","ed","ee","ef","f0","f1","f2","f3","f4","f5","f6","f7","f8","f9","fa","fb","fc","fd","fe","ff"];var nu=Math.PI/180,Fl=180/Math.PI;function Ta(){let i=Math.random()*4294967295|0,e=Math.random()*4294967295|0,t=Math.random()*4294967295|0,n=Math.random()*4294967295|0;return(kn[i&255]+kn[i>>8&255]+kn[i>>16&255]+kn[i>>24&255]+"-"+kn[e&255]+kn[e>>8&255]+"-"+kn[e>>16&15|64]+kn[e>>24&255]+"-"+kn[t&63|128]+kn[t>>8&255]+"-"+kn[t>>16&255]+kn[t>>24&255]+kn[n&255]+kn[n>>8&255]+kn[n>>16&255]+kn[n>>24&255]).toLowerCase()}function Mt(i,e,t){return Math.max(e,Math.min(t,i))}function Dv(i,e){return(i%e+e)%e}function iu(i,e,t){return(1-t)*i+t*e}function im(i){return Math.pow(2,Math.floor(Math.log(i)/Math.LN2))}function nd(i){switch(i.constructor){case Uint32Array:return 4294967295;case Uint16Array:return 65535;case Uint8Array:case Uint8ClampedArray:return 255;case Int32Array:return 2147483647;case Int16Array:return 32767;case Int8Array:return 127;default:return}}function Nv(i,e){if(e.constructor===Float32Array)return i;let t=nd(e);if(t===void 0)throw new Error("THREE.MathUtils: Invalid component type.");return Math.max(i/t,-1)}function Fv(i,e){if(e.constructor===Float32Array)return i;let t=nd(e);if(t===void 0)throw new Error("THREE.MathUtils: Invalid component type.");return Math.round(i*t)}var vt=class{static{this.prototype.isVector2=!0}constructor(e=0,t=0){this.x=e,this.y=t}get width(){return this.x}set width(e){this.x=e}get height(){return this.y}set height(e){this.y=e}set(e,t){return this.x=e,this.y=t,this}setScalar(e){return this.x=e,this.y=e,this}setX(e){return this.x=e,this}setY(e){return this.y=e,this}setComponent(e,t){switch(e){case 0:this.x=t;break;case 1:this.y=t;break;default:throw new Error("THREE.Vector2: index is out of range: "+e)}return this}getComponent(e){switch(e){case 0:return this.x;case 1:return this.y;default:throw new Error("THREE.Vector2: index is out of range: "+e)}}clone(){return new this.constructor(this.x,this.y)}copy(e){return this.x=e.x,this.y=e.y,this}add(e){return this.x+=e.x,this.y+=e.y,this}addScalar(e){return this.x+=e,this.y+=e,this}addVectors(e,t){return this.x=e.x+t.x,this.y=e.y+t.y,this}addScaledVector(e,t){return this.x+=e.x*t,this.y+=e.y*t,this}sub(e){return this.x-=e.x,this.y-=e.y,this}subScalar(e){return this.x-=e,this.y-=e,this}subVectors(e,t){return this.x=e.x-t.x,this.y=e.y-t.y,this}multiply(e){return this.x*=e.x,this.y*=e.y,this}multiplyScalar(e){return this.x*=e,this.y*=e,this}divide(e){return this.x/=e.x,this.y/=e.y,this}divideScalar(e){return this.multiplyScalar(1/e)}applyMatrix3(e){let t=this.x,n=this.y,s=e.elements;return this.x=s[0]*t+s[3]*n+s[6],this.y=s[1]*t+s[4]*n+s[7],this}min(e){return this.x=Math.min(this.x,e.x),this.y=Math.min(this.y,e.y),this}max(e){return this.x=Math.max(this.x,e.x),this.y=Math.max(this.y,e.y),this}clamp(e,t){return this.x=Mt(this.x,e.x,t.x),this.y=Mt(this.y,e.y,t.y),this}clampScalar(e,t){return this.x=Mt(this.x,e,t),this.y=Mt(this.y,e,t),this}clampLength(e,t){let n=this.length();return this.divideScalar(n||1).multiplyScalar(Mt(n,e,t))}floor(){return this.x=Math.floor(this.x),this.y=Math.floor(this.y),this}ceil(){return this.x=Math.ceil(this.x),this.y=Math.ceil(this.y),this}round(){return this.x=Math.round(this.x),this.y=Math.round(this.y),this}roundToZero(){return this.x=Math.trunc(this.x),this.y=Math.trunc(this.y),this}negate(){return this.x=-this.x,this.y=-this.y,this}dot(e){return this.x*e.x+this.y*e.y}cross(e){return this.x*e.y-this.y*e.x}lengthSq(){return this.x*this.x+this.y*this.y}length(){return Math.sqrt(this.x*this.x+this.y*this.y)}manhattanLength(){return Math.abs(this.x)+Math.abs(this.y)}normalize(){return this.divideScalar(this.length()||1)}angle(){return Math.atan2(-this.y,-this.x)+Math.PI}angleTo(e){let t=Math.sqrt(this.lengthSq()*e.lengthSq());if(t===0)return Math.PI/2;let n=this.dot(e)/t;return Math.acos(Mt(n,-1,1))}distanceTo(e){return Math.sqrt(this.distanceToSquared(e))}distanceToSquared(e){let t=this.x-e.x,n=this.y-e.y;return t*t+n*n}manhattanDistanceTo(e){return Math.abs(this.x-e.x)+Math.abs(this.y-e.y)}setLength(e){return this.normalize().multiplyScalar(e)}lerp(e,t){return this.x+=(e.x-this.x)*t,this.y+=(e.y-this.y)*t,this}lerpVectors(e,t,n){return this.x=e.x+(t.x-e.x)*n,this.y=e.y+(t.y-e.y)*n,this}equals(e){return e.x===this.x&&e.y===this.y}fromArray(e,t=0){return this.x=e[t],this.y=e[t+1],this}toArray(e=[],t=0){return e[t]=this.x,e[t+1]=this.y,e}fromBufferAttribute(e,t){return this.x=e.getX(t),this.y=e.getY(t),this}rotateAround(e,t){let n=Math.cos(t),s=Math.sin(t),r=this.x-e.x,o=this.y-e.y;return this.x=r*n-o*s+e.x,this.y=r*s+o*n+e.y,this}random(){return this.x=Math.random(),this.y=Math.random(),this}*[Symbol.iterator](){yield this.x,yield this.y}},Vn=class{constructor(e=0,t=0,n=0,s=1){this.isQuaternion=!0,this._x=e,this._y=t,this._z=n,this._w=s}static slerpFlat(e,t,n,s,r,o,a){let l=n[s+0],c=n[s+1],h=n[s+2],u=n[s+3],d=r[o+0],f=r[o+1],g=r[o+2],v=r[o+3];if(u!==v||l!==d||c!==f||h!==g){let p=l*d+c*f+h*g+u*v;p<0&&(d=-d,f=-f,g=-g,v=-v,p=-p);let m=1-a;if(p<.9995){let y=Math.acos(p),R=Math.sin(y);m=Math.sin(m*y)/R,a=Math.sin(a*y)/R,l=l*m+d*a,c=c*m+f*a,h=h*m+g*a,u=u*m+v*a}else{l=l*m+d*a,c=c*m+f*a,h=h*m+g*a,u=u*m+v*a;let y=1/Math.sqrt(l*l+c*c+h*h+u*u);l*=y,c*=y,h*=y,u*=y}}e[t]=l,e[t+1]=c,e[t+2]=h,e[t+3]=u}static multiplyQuaternionsFlat(e,t,n,s,r,o){let a=n[s],l=n[s+1],c=n[s+2],h=n[s+3],u=r[o],d=r[o+1],f=r[o+2],g=r[o+3];return e[t]=a*g+h*u+l*f-c*d,e[t+1]=l*g+h*d+c*u-a*f,e[t+2]=c*g+h*f+a*d-l*u,e[t+3]=h*g-a*u-l*d-c*f,e}get x(){return this._x}set x(e){this._x=e,this._onChangeCallback()}get y(){return this._y}set y(e){this._y=e,this._onChangeCallback()}get z(){return this._z}set z(e){this._z=e,this._onChangeCallback()}get w(){return this._w}set w(e){this._w=e,this._onChangeCallback()}set(e,t,n,s){return this._x=e,this._y=t,this._z=n,this._w=s,this._onChangeCallback(),this}clone(){return new this.constructor(this._x,this._y,this._z,this._w)}copy(e){return this._x=e.x,this._y=e.y,this._z=e.z,this._w=e.w,this._onChangeCallback(),this}setFromEuler(e,t=!0){let n=e._x,s=e._y,r=e._z,o=e._order,a=Math.cos,l=Math.sin,c=a(n/2),h=a(s/2),u=a(r/2),d=l(n/2),f=l(s/2),g=l(r/2);switch(o){case"XYZ":this._x=d*h*u+c*f*g,this._y=c*f*u-d*h*g,this._z=c*h*g+d*f*u,this._w=c*h*u-d*f*g;break;case"YXZ":this._x=d*h*u+c*f*g,this._y=c*f*u-d*h*g,this._z=c*h*g-d*f*u,this._w=c*h*u+d*f*g;break;case"ZXY":this._x=d*h*u-c*f*g,this._y=c*f*u+d*h*g,this._z=c*h*g+d*f*u,this._w=c*h*u-d*f*g;break;case"ZYX":this._x=d*h*u-c*f*g,this._y=c*f*u+d*h*g,this._z=c*h*g-d*f*u,this._w=c*h*u+d*f*g;break;case"YZX":this._x=d*h*u+c*f*g,this._y=c*f*u+d*h*g,this._z=c*h*g-d*f*u,this._w=c*h*u-d*f*g;break;case"XZY":this._x=d*h*u-c*f*g,this._y=c*f*u-d*h*g,this._z=c*h*g+d*f*u,this._w=c*h*u+d*f*g;break;default:$e("Quaternion: .setFromEuler() encountered an unknown order: "+o)}return t===!0&&this._onChangeCallback(),this}setFromAxisAngle(e,t){let n=t/2,s=Math.sin(n);return this._x=e.x*s,this._y=e.y*s,this._z=e.z*s,this._w=Math.cos(n),this._onChangeCallback(),this}setFromRotationMatrix(e){let t=e.elements,n=t[0],s=t[4],r=t[8],o=t[1],a=t[5],l=t[9],c=t[2],h=t[6],u=t[10],d=n+a+u;if(d>0){let f=.5/Math.sqrt(d+1);this._w=.25/f,this._x=(h-l)*f,this._y=(r-c)*f,this._z=(o-s)*f}else if(n>a&&n>u){let f=2*Math.sqrt(1+n-a-u);this._w=(h-l)/f,this._x=.25*f,this._y=(s+o)/f,this._z=(r+c)/f}else if(a>u){let f=2*Math.sqrt(1+a-n-u);this._w=(r-c)/f,this._x=(s+o)/f,this._y=.25*f,this._z=(l+h)/f}else{let f=2*Math.sqrt(1+u-n-a);this._w=(o-s)/f,this._x=(r+c)/f,this._y=(l+h)/f,this._z=.25*f}return this._onChangeCallback(),this}setFromUnitVectors(e,t){let n=e.dot(t)+1;return n<1e-8?(n=0,Math.abs(e.x)>Math.abs(e.z)?(this._x=-e.y,this._y=e.x,this._z=0,this._w=n):(this._x=0,this._y=-e.z,this._z=e.y,this._w=n)):(this._x=e.y*t.z-e.z*t.y,this._y=e.z*t.x-e.x*t.z,this._z=e.x*t.y-e.y*t.x,this._w=n),this.normalize()}angleTo(e){return 2*Math.acos(Math.abs(Mt(this.dot(e),-1,1)))}rotateTowards(e,t){let n=this.angleTo(e);if(n===0)return this;let s=Math.min(1,t/n);return this.slerp(e,s),this}identity(){return this.set(0,0,0,1)}invert(){return this.conjugate()}conjugate(){return this._x*=-1,this._y*=-1,this._z*=-1,this._onChangeCallback(),this}dot(e){return this._x*e._x+this._y*e._y+this._z*e._z+this._w*e._w}lengthSq(){return this._x*this._x+this._y*this._y+this._z*this._z+this._w*this._w}length(){return Math.sqrt(this._x*this._x+this._y*this._y+this._z*this._z+this._w*this._w)}normalize(){let e=this.length();return e===0?(this._x=0,this._y=0,this._z=0,this._w=1):(e=1/e,this._x=this._x*e,this._y=this._y*e,this._z=this._z*e,this._w=this._w*e),this._onChangeCallback(),this}multiply(e){return this.multiplyQuaternions(this,e)}premultiply(e){return this.multiplyQuaternions(e,this)}multiplyQuaternions(e,t){let n=e._x,s=e._y,r=e._z,o=e._w,a=t._x,l=t._y,c=t._z,h=t._w;return this._x=n*h+o*a+s*c-r*l,this._y=s*h+o*l+r*a-n*c,this._z=r*h+o*c+n*l-s*a,this._w=o*h-n*a-s*l-r*c,this._onChangeCallback(),this}slerp(e,t){let n=e._x,s=e._y,r=e._z,o=e._w,a=this.dot(e);a<0&&(n=-n,s=-s,r=-r,o=-o,a=-a);let l=1-t;if(a<.9995){let c=Math.acos(a),h=Math.sin(c);l=Math.sin(l*c)/h,t=Math.sin(t*c)/h,this._x=this._x*l+n*t,this._y=this._y*l+s*t,this._z=this._z*l+r*t,this._w=this._w*l+o*t,this._onChangeCallback()}else this._x=this._x*l+n*t,this._y=this._y*l+s*t,this._z=this._z*l+r*t,this._w=this._w*l+o*t,this.normalize();return this}slerpQuaternions(e,t,n){return this.copy(e).slerp(t,n)}random(){let e=2*Math.PI*Math.random(),t=2*Math.PI*Math.random(),n=Math.random(),s=Math.sqrt(1-n),r=Math.sqrt(n);return this.set(s*Math.sin(e),s*Math.cos(e),r*Math.sin(t),r*Math.cos(t))}equals(e){return e._x===this._x&&e._y===this._y&&e._z===this._z&&e._w===this._w}fromArray(e,t=0){return this._x=e[t],this._y=e[t+1],this._z=e[t+2],this._w=e[t+3],this._onChangeCallback(),this}toArray(e=[],t=0){return e[t]=this._x,e[t+1]=this._y,e[t+2]=this._z,e[t+3]=this._w,e}fromBufferAttribute(e,t){return this._x=e.getX(t),this._y=e.getY(t),this._z=e.getZ(t),this._w=e.getW(t),this._onChangeCallback(),this}toJSON(){return this.toArray()}_onChange(e){return this._onChangeCallback=e,this}_onChangeCallback(){}*[Symbol.iterator](){yield this._x,yield this._y,yield this._z,yield this._w}},k=class{static{this.prototype.isVector3=!0}constructor(e=0,t=0,n=0){this.x=e,this.y=t,this.z=n}set(e,t,n){return n===void 0&&(n=this.z),this.x=e,this.y=t,this.z=n,this}setScalar(e){return this.x=e,this.y=e,this.z=e,this}setX(e){return this.x=e,this}setY(e){return this.y=e,this}setZ(e){return this.z=e,this}setComponent(e,t){switch(e){case 0:this.x=t;break;case 1:this.y=t;break;case 2:this.z=t;break;default:throw new Error("THREE.Vector3: index is out of range: "+e)}return this}getComponent(e){switch(e){case 0:return this.x;case 1:return this.y;case 2:return this.z;default:throw new Error("THREE.Vector3: index is out of range: "+e)}}clone(){return new this.constructor(this.x,this.y,this.z)}copy(e){return this.x=e.x,this.y=e.y,this.z=e.z,this}add(e){return this.x+=e.x,this.y+=e.y,this.z+=e.z,this}addScalar(e){return this.x+=e,this.y+=e,this.z+=e,this}addVectors(e,t){return this.x=e.x+t.x,this.y=e.y+t.y,this.z=e.z+t.z,this}addScaledVector(e,t){return this.x+=e.x*t,this.y+=e.y*t,this.z+=e.z*t,this}sub(e){return this.x-=e.x,this.y-=e.y,this.z-=e.z,this}subScalar(e){return this.x-=e,this.y-=e,this.z-=e,this}subVectors(e,t){return this.x=e.x-t.x,this.y=e.y-t.y,this.z=e.z-t.z,this}multiply(e){return this.x*=e.x,this.y*=e.y,this.z*=e.z,this}multiplyScalar(e){return this.x*=e,this.y*=e,this.z*=e,this}multiplyVectors(e,t){return this.x=e.x*t.x,this.y=e.y*t.y,this.z=e.z*t.z,this}applyEuler(e){return this.applyQuaternion(qf.setFromEuler(e))}applyAxisAngle(e,t){return this.applyQuaternion(qf.setFromAxisAngle(e,t))}applyMatrix3(e){let t=this.x,n=this.y,s=this.z,r=e.elements;return this.x=r[0]*t+r[3]*n+r[6]*s,this.y=r[1]*t+r[4]*n+r[7]*s,this.z=r[2]*t+r[5]*n+r[8]*s,this}applyNormalMatrix(e){return this.applyMatrix3(e).normalize()}applyMatrix4(e){let t=this.x,n=this.y,s=this.z,r=e.elements,o=1/(r[3]*t+r[7]*n+r[11]*s+r[15]);return this.x=(r[0]*t+r[4]*n+r[8]*s+r[12])*o,this.y=(r[1]*t+r[5]*n+r[9]*s+r[13])*o,this.z=(r[2]*t+r[6]*n+r[10]*s+r[14])*o,this}applyQuaternion(e){let t=this.x,n=this.y,s=this.z,r=e.x,o=e.y,a=e.z,l=e.w,c=2*(o*s-a*n),h=2*(a*t-r*s),u=2*(r*n-o*t);return this.x=t+l*c+o*u-a*h,this.y=n+l*h+a*c-r*u,this.z=s+l*u+r*h-o*c,this}project(e){return this.applyMatrix4(e.matrixWorldInverse).applyMatrix4(e.projectionMatrix)}unproject(e){return this.applyMatrix4(e.projectionMatrixInverse).applyMatrix4(e.matrixWorld)}transformDirection(e){let t=this.x,n=this.y,s=this.z,r=e.elements;return this.x=r[0]*t+r[4]*n+r[8]*s,this.y=r[1]*t+r[5]*n+r[9]*s,this.z=r[2]*t+r[6]*n+r[10]*s,this.normalize()}divide(e){return this.x/=e.x,this.y/=e.y,this.z/=e.z,this}divideScalar(e){return this.multiplyScalar(1/e)}min(e){return this.x=Math.min(this.x,e.x),this.y=Math.min(this.y,e.y),this.z=Math.min(this.z,e.z),this}max(e){return this.x=Math.max(this.x,e.x),this.y=Math.max(this.y,e.y),this.z=Math.max(this.z,e.z),this}clamp(e,t){return this.x=Mt(this.x,e.x,t.x),this.y=Mt(this.y,e.y,t.y),this.z=Mt(this.z,e.z,t.z),this}clampScalar(e,t){return this.x=Mt(this.x,e,t),this.y=Mt(this.y,e,t),this.z=Mt(this.z,e,t),this}clampLength(e,t){let n=this.length();return this.divideScalar(n||1).multiplyScalar(Mt(n,e,t))}floor(){return this.x=Math.floor(this.x),this.y=Math.floor(this.y),this.z=Math.floor(this.z),this}ceil(){return this.x=Math.ceil(this.x),this.y=Math.ceil(this.y),this.z=Math.ceil(this.z),this}round(){return this.x=Math.round(this.x),this.y=Math.round(this.y),this.z=Math.round(this.z),this}roundToZero(){return this.x=Math.trunc(this.x),this.y=Math.trunc(this.y),this.z=Math.trunc(this.z),this}negate(){return this.x=-this.x,this.y=-this.y,this.z=-this.z,this}dot(e){return this.x*e.x+this.y*e.y+this.z*e.z}lengthSq(){return this.x*this.x+this.y*this.y+this.z*this.z}length(){return Math.sqrt(this.x*this.x+this.y*this.y+this.z*this.z)}manhattanLength(){return Math.abs(this.x)+Math.abs(this.y)+Math.abs(this.z)}normalize(){return this.divideScalar(this.length()||1)}setLength(e){return this.normalize().multiplyScalar(e)}lerp(e,t){return this.x+=(e.x-this.x)*t,this.y+=(e.y-this.y)*t,this.z+=(e.z-this.z)*t,this}lerpVectors(e,t,n){return this.x=e.x+(t.x-e.x)*n,this.y=e.y+(t.y-e.y)*n,this.z=e.z+(t.z-e.z)*n,this}cross(e){return this.crossVectors(this,e)}crossVectors(e,t){let n=e.x,s=e.y,r=e.z,o=t.x,a=t.y,l=t.z;return this.x=s*l-r*a,this.y=r*o-n*l,this.z=n*a-s*o,this}projectOnVector(e){let t=e.lengthSq();if(t===0)return this.set(0,0,0);let n=e.dot(this)/t;return this.copy(e).multiplyScalar(n)}projectOnPlane(e){return su.copy(this).projectOnVector(e),this.sub(su)}reflect(e){return this.sub(su.copy(e).multiplyScalar(2*this.dot(e)))}angleTo(e){let t=Math.sqrt(this.lengthSq()*e.lengthSq());if(t===0)return Math.PI/2;let n=this.dot(e)/t;return Math.acos(Mt(n,-1,1))}distanceTo(e){return Math.sqrt(this.distanceToSquared(e))}distanceToSquared(e){let t=this.x-e.x,n=this.y-e.y,s=this.z-e.z;return t*t+n*n+s*s}manhattanDistanceTo(e){return Math.abs(this.x-e.x)+Math.abs(this.y-e.y)+Math.abs(this.z-e.z)}setFromSpherical(e){return this.setFromSphericalCoords(e.radius,e.phi,e.theta)}setFromSphericalCoords(e,t,n){let s=Math.sin(t)*e;return this.x=s*Math.sin(n),this.y=Math.cos(t)*e,this.z=s*Math.cos(n),this}setFromCylindrical(e){return this.setFromCylindricalCoords(e.radius,e.theta,e.y)}setFromCylindricalCoords(e,t,n){return this.x=e*Math.sin(t),this.y=n,this.z=e*Math.cos(t),this}setFromMatrixPosition(e){let t=e.elements;return this.x=t[12],this.y=t[13],this.z=t[14],this}setFromMatrixScale(e){let t=this.setFromMatrixColumn(e,0).length(),n=this.setFromMatrixColumn(e,1).length(),s=this.setFromMatrixColumn(e,2).length();return this.x=t,this.y=n,this.z=s,this}setFromMatrixColumn(e,t){return this.fromArray(e.elements,t*4)}setFromMatrix3Column(e,t){return this.fromArray(e.elements,t*3)}setFromEuler(e){return this.x=e._x,this.y=e._y,this.z=e._z,this}setFromColor(e){return this.x=e.r,this.y=e.g,this.z=e.b,this}equals(e){return e.x===this.x&&e.y===this.y&&e.z===this.z}fromArray(e,t=0){return this.x=e[t],this.y=e[t+1],this.z=e[t+2],this}toArray(e=[],t=0){return e[t]=this.x,e[t+1]=this.y,e[t+2]=this.z,e}fromBufferAttribute(e,t){return this.x=e.getX(t),this.y=e.getY(t),this.z=e.getZ(t),this}random(){return this.x=Math.random(),this.y=Math.random(),this.z=Math.random(),this}randomDirection(){let e=Math.random()*Math.PI*2,t=Math.random()*2-1,n=Math.sqrt(1-t*t);return this.x=n*Math.cos(e),this.y=t,this.z=n*Math.sin(e),this}*[Symbol.iterator](){yield this.x,yield this.y,yield this.z}},su=new k,qf=new Vn,qe=class{static{this.prototype.isMatrix3=!0}constructor(e,t,n,s,r,o,a,l,c){this.elements=[1,0,0,0,1,0,0,0,1],e!==void 0&&this.set(e,t,n,s,r,o,a,l,c)}set(e,t,n,s,r,o,a,l,c){let h=this.elements;return h[0]=e,h[1]=s,h[2]=a,h[3]=t,h[4]=r,h[5]=l,h[6]=n,h[7]=o,h[8]=c,this}identity(){return this.set(1,0,0,0,1,0,0,0,1),this}copy(e){let t=this.elements,n=e.elements;return t[0]=n[0],t[1]=n[1],t[2]=n[2],t[3]=n[3],t[4]=n[4],t[5]=n[5],t[6]=n[6],t[7]=n[7],t[8]=n[8],this}extractBasis(e,t,n){return e.setFromMatrix3Column(this,0),t.setFromMatrix3Column(this,1),n.setFromMatrix3Column(this,2),this}setFromMatrix4(e){let t=e.elements;return this.set(t[0],t[4],t[8],t[1],t[5],t[9],t[2],t[6],t[10]),this}multiply(e){return this.multiplyMatrices(this,e)}premultiply(e){return this.multiplyMatrices(e,this)}multiplyMatrices(e,t){let n=e.elements,s=t.elements,r=this.elements,o=n[0],a=n[3],l=n[6],c=n[1],h=n[4],u=n[7],d=n[2],f=n[5],g=n[8],v=s[0],p=s[3],m=s[6],y=s[1],R=s[4],b=s[7],A=s[2],E=s[5],_=s[8];return r[0]=o*v+a*y+l*A,r[3]=o*p+a*R+l*E,r[6]=o*m+a*b+l*_,r[1]=c*v+h*y+u*A,r[4]=c*p+h*R+u*E,r[7]=c*m+h*b+u*_,r[2]=d*v+f*y+g*A,r[5]=d*p+f*R+g*E,r[8]=d*m+f*b+g*_,this}multiplyScalar(e){let t=this.elements;return t[0]*=e,t[3]*=e,t[6]*=e,t[1]*=e,t[4]*=e,t[7]*=e,t[2]*=e,t[5]*=e,t[8]*=e,this}determinant(){let e=this.elements,t=e[0],n=e[1],s=e[2],r=e[3],o=e[4],a=e[5],l=e[6],c=e[7],h=e[8];return t*o*h-t*a*c-n*r*h+n*a*l+s*r*c-s*o*l}invert(){let e=this.elements,t=e[0],n=e[1],s=e[2],r=e[3],o=e[4],a=e[5],l=e[6],c=e[7],h=e[8],u=h*o-a*c,d=a*l-h*r,f=c*r-o*l,g=t*u+n*d+s*f;if(g===0)return this.set(0,0,0,0,0,0,0,0,0);let v=1/g;return e[0]=u*v,e[1]=(s*c-h*n)*v,e[2]=(a*n-s*o)*v,e[3]=d*v,e[4]=(h*t-s*l)*v,e[5]=(s*r-a*t)*v,e[6]=f*v,e[7]=(n*l-c*t)*v,e[8]=(o*t-n*r)*v,this}transpose(){let e,t=this.elements;return e=t[1],t[1]=t[3],t[3]=e,e=t[2],t[2]=t[6],t[6]=e,e=t[5],t[5]=t[7],t[7]=e,this}getNormalMatrix(e){return this.setFromMatrix4(e).invert().transpose()}transposeIntoArray(e){let t=this.elements;return e[0]=t[0],e[1]=t[3],e[2]=t[6],e[3]=t[1],e[4]=t[4],e[5]=t[7],e[6]=t[2],e[7]=t[5],e[8]=t[8],this}setUvTransform(e,t,n,s,r,o,a){let l=Math.cos(r),c=Math.sin(r);return this.set(n*l,n*c,-n*(l*o+c*a)+o+e,-s*c,s*l,-s*(-c*o+l*a)+a+t,0,0,1),this}scale(e,t){return jo("Matrix3: .scale() is deprecated. Use .makeScale() instead."),this.premultiply(ru.makeScale(e,t)),this}rotate(e){return jo("Matrix3: .rotate() is deprecated. Use .makeRotation() instead."),this.premultiply(ru.makeRotation(-e)),this}translate(e,t){return jo("Matrix3: .translate() is deprecated. Use .makeTranslation() instead."),this.premultiply(ru.makeTranslation(e,t)),this}makeTranslation(e,t){return e.isVector2?this.set(1,0,e.x,0,1,e.y,0,0,1):this.set(1,0,e,0,1,t,0,0,1),this}makeRotation(e){let t=Math.cos(e),n=Math.sin(e);return this.set(t,-n,0,n,t,0,0,0,1),this}makeScale(e,t){return this.set(e,0,0,0,t,0,0,0,1),this}equals(e){let t=this.elements,n=e.elements;for(let s=0;s<9;s++)if(t[s]!==n[s])return!1;return!0}fromArray(e,t=0){for(let n=0;n<9;n++)this.elements[n]=e[n+t];return this}toArray(e=[],t=0){let n=this.elements;return e[t]=n[0],e[t+1]=n[1],e[t+2]=n[2],e[t+3]=n[3],e[t+4]=n[4],e[t+5]=n[5],e[t+6]=n[6],e[t+7]=n[7],e[t+8]=n[8],e}clone(){return new this.constructor().fromArray(this.elements)}},ru=new qe,Yf=new qe().set(.4123908,.3575843,.1804808,.212639,.7151687,.0721923,.0193308,.1191948,.9505322),$f=new qe().set(3.2409699,-1.5373832,-.4986108,-.9692436,1.8759675,.0415551,.0556301,-.203977,1.0569715);function Uv(){let i={enabled:!0,workingColorSpace:mr,spaces:{},convert:function(s,r,o){return this.enabled===!1||r===o||!r||!o||(this.spaces[r].transfer===Pt&&(s.r=bs(s.r),s.g=bs(s.g),s.b=bs(s.b)),this.spaces[r].primaries!==this.spaces[o].primaries&&(s.applyMatrix3(this.spaces[r].toXYZ),s.applyMatrix3(this.spaces[o].fromXYZ)),this.spaces[o].transfer===Pt&&(s.r=ro(s.r),s.g=ro(s.g),s.b=ro(s.b))),s},workingToColorSpace:function(s,r){return this.convert(s,this.workingColorSpace,r)},colorSpaceToWorking:function(s,r){return this.convert(s,r,this.workingColorSpace)},getPrimaries:function(s){return this.spaces[s].primaries},getTransfer:function(s){return s===Rs?ea:this.spaces[s].transfer},getToneMappingMode:function(s){return this.spaces[s].outputColorSpaceConfig.toneMappingMode||"standard"},getLuminanceCoefficients:function(s,r=this.workingColorSpace){return s.fromArray(this.spaces[r].luminanceCoefficients)},define:function(s){Object.assign(this.spaces,s)},_getMatrix:function(s,r,o){return s.copy(this.spaces[o].fromXYZ).multiply(this.spaces[r].toXYZ)},_getDrawingBufferColorSpace:function(s){return this.spaces[s].outputColorSpaceConfig.drawingBufferColorSpace},_getUnpackColorSpace:function(s=this.workingColorSpace){return this.spaces[s].workingColorSpaceConfig.unpackColorSpace}},e=[.64,.33,.3,.6,.15,.06],t=[.2126,.7152,.0722],n=[.3127,.329];return i.define({[mr]:{primaries:e,whitePoint:n,transfer:ea,toXYZ:Yf,fromXYZ:$f,luminanceCoefficients:t,workingColorSpaceConfig:{unpackColorSpace:fi},outputColorSpaceConfig:{drawingBufferColorSpace:fi}},[fi]:{primaries:e,whitePoint:n,transfer:Pt,toXYZ:Yf,fromXYZ:$f,luminanceCoefficients:t,outputColorSpaceConfig:{drawingBufferColorSpace:fi}}}),i}var gt=Uv();function bs(i){return i<.04045?i*.0773993808:Math.pow(i*.9478672986+.0521327014,2.4)}function ro(i){return i<.0031308?i*12.92:1.055*Math.pow(i,.41666)-.055}var Xr,Ul=class{static getDataURL(e,t="image/png"){if(/^data:/i.test(e.src)||typeof HTMLCanvasElement>"u")return e.src;let n;if(e instanceof HTMLCanvasElement)n=e;else{Xr===void 0&&(Xr=na("canvas")),Xr.width=e.width,Xr.height=e.height;let s=Xr.getContext("2d");e instanceof ImageData?s.putImageData(e,0,0):s.drawImage(e,0,0,e.width,e.height),n=Xr}return n.toDataURL(t)}static sRGBToLinear(e){if(typeof HTMLImageElement<"u"&&e instanceof HTMLImageElement||typeof HTMLCanvasElement<"u"&&e instanceof HTMLCanvasElement||typeof ImageBitmap<"u"&&e instanceof ImageBitmap){let t=na("canvas");t.width=e.width,t.height=e.height;let n=t.getContext("2d");n.drawImage(e,0,0,e.width,e.height);let s=n.getImageData(0,0,e.width,e.height),r=s.data;for(let o=0;o<r.length;o++)r[o]=bs(r[o]/255)*255;return n.putImageData(s,0,0),t}else if(e.data){let t=e.data.slice(0);for(let n=0;n<t.length;n++)t instanceof Uint8Array||t instanceof Uint8ClampedArray?t[n]=Math.floor(bs(t[n]/255)*255):t[n]=bs(t[n]);return{data:t,width:e.width,height:e.height}}else return $e("ImageUtils.sRGBToLinear(): Unsupported image type. No color space conversion applied."),e}},Ov=0,lo=class{constructor(e=null){this.isTextureSource=!0,Object.defineProperty(this,"id",{value:Ov++}),this.uuid=Ta(),this.data=e,this.dataReady=!0,this.version=0}getSize(e){let t=this.data;return typeof HTMLVideoElement<"u"&&t instanceof HTMLVideoElement?e.set(t.videoWidth,t.videoHeight,0):typeof VideoFrame<"u"&&t instanceof VideoFrame?e.set(t.displayWidth,t.displayHeight,0):t!==null?e.set(t.width||0,t.height||0,t.depth||0):e.set(0,0,0),e}set needsUpdate(e){e===!0&&this.version++}toJSON(e){let t=e===void 0||typeof e=="string";if(!t&&e.images[this.uuid]!==void 0)return e.images[this.uuid];let n={uuid:this.uuid,url:""},s=this.data;if(s!==null){let r;if(Array.isArray(s)){r=[];for(let o=0,a=s.length;o<a;o++)s[o].isDataTexture?r.push(ou(s[o].image)):r.push(ou(s[o]))}else r=ou(s);n.url=r}return t||(e.images[this.uuid]=n),n}};function ou(i){return typeof HTMLImageElement<"u"&&i instanceof HTMLImageElement||typeof HTMLCanvasElement<"u"&&i instanceof HTMLCanvasElement||typeof ImageBitmap<"u"&&i instanceof ImageBitmap?Ul.getDataURL(i):i.data?{data:Array.from(i.data),width:i.width,height:i.height,type:i.data.constructor.name}:($e("Texture: Unable to serialize Texture."),{})}var Bv=0,au=new k,Un=class i extends ns{constructor(e=i.DEFAULT_IMAGE,t=i.DEFAULT_MAPPING,n=ts,s=ts,r=Fn,o=vi,a=yi,l=_i,c=i.DEFAULT_ANISOTROPY,h=Rs){super(),this.isTexture=!0,Object.defineProperty(this,"id",{value:Bv++}),this.uuid=Ta(),this.name="",this.source=new lo(e),this.mipmaps=[],this.mapping=t,this.channel=0,this.wrapS=n,this.wrapT=s,this.magFilter=r,this.minFilter=o,this.anisotropy=c,this.format=a,this.internalFormat=null,this.type=l,this.offset=new vt(0,0),this.repeat=new vt(1,1),this.center=new vt(0,0),this.rotation=0,this.matrixAutoUpdate=!0,this.matrix=new qe,this.generateMipmaps=!0,this.mipmapsAutoUpdate=!0,this.premultiplyAlpha=!1,this.flipY=!0,this.unpackAlignment=4,this.colorSpace=h,this.userData={},this.updateRanges=[],this.version=0,this.onUpdate=null,this.renderTarget=null,this.isRenderTargetTexture=!1,this.isArrayTexture=!!(e&&e.depth&&e.depth>1),this.pmremVersion=0,this.isPMREMTexture=!1,this.normalized=!1}get width(){return this.source.getSize(au).x}get height(){return this.source.getSize(au).y}get depth(){return this.source.getSize(au).z}get image(){return this.source.data}set image(e){this.source.data=e}updateMatrix(){this.matrix.setUvTransform(this.offset.x,this.offset.y,this.repeat.x,this.repeat.y,this.rotation,this.center.x,this.center.y)}addUpdateRange(e,t){this.updateRanges.push({start:e,count:t})}clearUpdateRanges(){this.updateRanges.length=0}clone(){return new this.constructor().copy(this)}copy(e){return this.name=e.name,this.source=e.source,this.mipmaps=e.mipmaps.slice(0),this.mapping=e.mapping,this.channel=e.channel,this.wrapS=e.wrapS,this.wrapT=e.wrapT,this.magFilter=e.magFilter,this.minFilter=e.minFilter,this.anisotropy=e.anisotropy,this.format=e.format,this.internalFormat=e.internalFormat,this.type=e.type,this.normalized=e.normalized,this.offset.copy(e.offset),this.repeat.copy(e.repeat),this.center.copy(e.center),this.rotation=e.rotation,this.matrixAutoUpdate=e.matrixAutoUpdate,this.matrix.copy(e.matrix),this.generateMipmaps=e.generateMipmaps,this.mipmapsAutoUpdate=e.mipmapsAutoUpdate,this.premultiplyAlpha=e.premultiplyAlpha,this.flipY=e.flipY,this.unpackAlignment=e.unpackAlignment,this.colorSpace=e.colorSpace,this.renderTarget=e.renderTarget,this.isRenderTargetTexture=e.isRenderTargetTexture,this.isPMREMTexture=e.isPMREMTexture,this.isArrayTexture=e.isArrayTexture,this.userData=JSON.parse(JSON.stringify(e.userData)),this.needsUpdate=!0,this}setValues(e){for(let t in e){let n=e[t];if(n===void 0){$e(`Texture.setValues(): parameter '${t}' has value of undefined.`);continue}let s=this[t];if(s===void 0){$e(`Texture.setValues(): property '${t}' does not exist.`);continue}s&&n&&s.isVector2&&n.isVector2||s&&n&&s.isVector3&&n.isVector3||s&&n&&s.isMatrix3&&n.isMatrix3?s.copy(n):this[t]=n}}toJSON(e){let t=e===void 0||typeof e=="string";if(!t&&e.textures[this.uuid]!==void 0)return e.textures[this.uuid];let n={metadata:{version:4.7,type:"Texture",generator:"Texture.toJSON"},uuid:this.uuid,name:this.name,image:this.source.toJSON(e).uuid,mapping:this.mapping,channel:this.channel,repeat:[this.repeat.x,this.repeat.y],offset:[this.offset.x,this.offset.y],center:[this.center.x,this.center.y],rotation:this.rotation,wrap:[this.wrapS,this.wrapT],format:this.format,internalFormat:this.internalFormat,type:this.type,normalized:this.normalized,colorSpace:this.colorSpace,minFilter:this.minFilter,magFilter:this.magFilter,anisotropy:this.anisotropy,flipY:this.flipY,generateMipmaps:this.generateMipmaps,mipmapsAutoUpdate:this.mipmapsAutoUpdate,premultiplyAlpha:this.premultiplyAlpha,unpackAlignment:this.unpackAlignment};return Object.keys(this.userData).length>0&&(n.userData=this.userData),t||(e.textures[this.uuid]=n),n}dispose(){this.dispatchEvent({type:"dispose"})}transformUv(e){if(this.mapping!==Wu)return e;if(e.applyMatrix3(this.matrix),e.x<0||e.x>1)switch(this.wrapS){case Ks:e.x=e.x-Math.floor(e.x);break;case ts:e.x=e.x<0?0:1;break;case Dl:Math.abs(Math.floor(e.x)%2)===1?e.x=Math.ceil(e.x)-e.x:e.x=e.x-Math.floor(e.x);break}if(e.y<0||e.y>1)switch(this.wrapT){case Ks:e.y=e.y-Math.floor(e.y);break;case ts:e.y=e.y<0?0:1;break;case Dl:Math.abs(Math.floor(e.y)%2)===1?e.y=Math.ceil(e.y)-e.y:e.y=e.y-Math.floor(e.y);break}return this.flipY&&(e.y=1-e.y),e}set needsUpdate(e){e===!0&&(this.version++,this.source.needsUpdate=!0)}set needsPMREMUpdate(e){e===!0&&this.pmremVersion++}};Un.DEFAULT_IMAGE=null;Un.DEFAULT_MAPPING=Wu;Un.DEFAULT_ANISOTROPY=1;var en=class{static{this.prototype.isVector4=!0}constructor(e=0,t=0,n=0,s=1){this.x=e,this.y=t,this.z=n,this.w=s}get width(){return this.z}set width(e){this.z=e}get height(){return this.w}set height(e){this.w=e}set(e,t,n,s){return this.x=e,this.y=t,this.z=n,this.w=s,this}setScalar(e){return this.x=e,this.y=e,this.z=e,this.w=e,this}setX(e){return this.x=e,this}setY(e){return this.y=e,this}setZ(e){return this.z=e,this}setW(e){return this.w=e,this}setComponent(e,t){switch(e){case 0:this.x=t;break;case 1:this.y=t;break;case 2:this.z=t;break;case 3:this.w=t;break;default:throw new Error("THREE.Vector4: index is out of range: "+e)}return this}getComponent(e){switch(e){case 0:return this.x;case 1:return this.y;case 2:return this.z;case 3:return this.w;default:throw new Error("THREE.Vector4: index is out of range: "+e)}}clone(){return new this.constructor(this.x,this.y,this.z,this.w)}copy(e){return this.x=e.x,this.y=e.y,this.z=e.z,this.w=e.w!==void 0?e.w:1,this}add(e){return this.x+=e.x,this.y+=e.y,this.z+=e.z,this.w+=e.w,this}addScalar(e){return this.x+=e,this.y+=e,this.z+=e,this.w+=e,this}addVectors(e,t){return this.x=e.x+t.x,this.y=e.y+t.y,this.z=e.z+t.z,this.w=e.w+t.w,this}addScaledVector(e,t){return this.x+=e.x*t,this.y+=e.y*t,this.z+=e.z*t,this.w+=e.w*t,this}sub(e){return this.x-=e.x,this.y-=e.y,this.z-=e.z,this.w-=e.w,this}subScalar(e){return this.x-=e,this.y-=e,this.z-=e,this.w-=e,this}subVectors(e,t){return this.x=e.x-t.x,this.y=e.y-t.y,this.z=e.z-t.z,this.w=e.w-t.w,this}multiply(e){return this.x*=e.x,this.y*=e.y,this.z*=e.z,this.w*=e.w,this}multiplyScalar(e){return this.x*=e,this.y*=e,this.z*=e,this.w*=e,this}applyMatrix4(e){let t=this.x,n=this.y,s=this.z,r=this.w,o=e.elements;return this.x=o[0]*t+o[4]*n+o[8]*s+o[12]*r,this.y=o[1]*t+o[5]*n+o[9]*s+o[13]*r,this.z=o[2]*t+o[6]*n+o[10]*s+o[14]*r,this.w=o[3]*t+o[7]*n+o[11]*s+o[15]*r,this}divide(e){return this.x/=e.x,this.y/=e.y,this.z/=e.z,this.w/=e.w,this}divideScalar(e){return this.multiplyScalar(1/e)}setAxisAngleFromQuaternion(e){this.w=2*Math.acos(e.w);let t=Math.sqrt(1-e.w*e.w);return t<1e-4?(this.x=1,this.y=0,this.z=0):(this.x=e.x/t,this.y=e.y/t,this.z=e.z/t),this}setAxisAngleFromRotationMatrix(e){let t,n,s,r,l=e.elements,c=l[0],h=l[4],u=l[8],d=l[1],f=l[5],g=l[9],v=l[2],p=l[6],m=l[10];if(Math.abs(h-d)<.01&&Math.abs(u-v)<.01&&Math.abs(g-p)<.01){if(Math.abs(h+d)<.1&&Math.abs(u+v)<.1&&Math.abs(g+p)<.1&&Math.abs(c+f+m-3)<.1)return this.set(1,0,0,0),this;t=Math.PI;let R=(c+1)/2,b=(f+1)/2,A=(m+1)/2,E=(h+d)/4,_=(u+v)/4,T=(g+p)/4;return R>b&&R>A?R<.01?(n=0,s=.707106781,r=.707106781):(n=Math.sqrt(R),s=E/n,r=_/n):b>A?b<.01?(n=.707106781,s=0,r=.707106781):(s=Math.sqrt(b),n=E/s,r=T/s):A<.01?(n=.707106781,s=.707106781,r=0):(r=Math.sqrt(A),n=_/r,s=T/r),this.set(n,s,r,t),this}let y=Math.sqrt((p-g)*(p-g)+(u-v)*(u-v)+(d-h)*(d-h));return Math.abs(y)<.001&&(y=1),this.x=(p-g)/y,this.y=(u-v)/y,this.z=(d-h)/y,this.w=Math.acos((c+f+m-1)/2),this}setFromMatrixPosition(e){let t=e.elements;return this.x=t[12],this.y=t[13],this.z=t[14],this.w=t[15],this}min(e){return this.x=Math.min(this.x,e.x),this.y=Math.min(this.y,e.y),this.z=Math.min(this.z,e.z),this.w=Math.min(this.w,e.w),this}max(e){return this.x=Math.max(this.x,e.x),this.y=Math.max(this.y,e.y),this.z=Math.max(this.z,e.z),this.w=Math.max(this.w,e.w),this}clamp(e,t){return this.x=Mt(this.x,e.x,t.x),this.y=Mt(this.y,e.y,t.y),this.z=Mt(this.z,e.z,t.z),this.w=Mt(this.w,e.w,t.w),this}clampScalar(e,t){return this.x=Mt(this.x,e,t),this.y=Mt(this.y,e,t),this.z=Mt(this.z,e,t),this.w=Mt(this.w,e,t),this}clampLength(e,t){let n=this.length();return this.divideScalar(n||1).multiplyScalar(Mt(n,e,t))}floor(){return this.x=Math.floor(this.x),this.y=Math.floor(this.y),this.z=Math.floor(this.z),this.w=Math.floor(this.w),this}ceil(){return this.x=Math.ceil(this.x),this.y=Math.ceil(this.y),this.z=Math.ceil(this.z),this.w=Math.ceil(this.w),this}round(){return this.x=Math.round(this.x),this.y=Math.round(this.y),this.z=Math.round(this.z),this.w=Math.round(this.w),this}roundToZero(){return this.x=Math.trunc(this.x),this.y=Math.trunc(this.y),this.z=Math.trunc(this.z),this.w=Math.trunc(this.w),this}negate(){return this.x=-this.x,this.y=-this.y,this.z=-this.z,this.w=-this.w,this}dot(e){return this.x*e.x+this.y*e.y+this.z*e.z+this.w*e.w}lengthSq(){return this.x*this.x+this.y*this.y+this.z*this.z+this.w*this.w}length(){return Math.sqrt(this.x*this.x+this.y*this.y+this.z*this.z+this.w*this.w)}manhattanLength(){return Math.abs(this.x)+Math.abs(this.y)+Math.abs(this.z)+Math.abs(this.w)}normalize(){return this.divideScalar(this.length()||1)}setLength(e){return this.normalize().multiplyScalar(e)}lerp(e,t){return this.x+=(e.x-this.x)*t,this.y+=(e.y-this.y)*t,this.z+=(e.z-this.z)*t,this.w+=(e.w-this.w)*t,this}lerpVectors(e,t,n){return this.x=e.x+(t.x-e.x)*n,this.y=e.y+(t.y-e.y)*n,this.z=e.z+(t.z-e.z)*n,this.w=e.w+(t.w-e.w)*n,this}equals(e){return e.x===this.x&&e.y===this.y&&e.z===this.z&&e.w===this.w}fromArray(e,t=0){return this.x=e[t],this.y=e[t+1],this.z=e[t+2],this.w=e[t+3],this}toArray(e=[],t=0){return e[t]=this.x,e[t+1]=this.y,e[t+2]=this.z,e[t+3]=this.w,e}fromBufferAttribute(e,t){return this.x=e.getX(t),this.y=e.getY(t),this.z=e.getZ(t),this.w=e.getW(t),this}random(){return this.x=Math.random(),this.y=Math.random(),this.z=Math.random(),this.w=Math.random(),this}*[Symbol.iterator](){yield this.x,yield this.y,yield this.z,yield this.w}},Ol=class extends ns{constructor(e=1,t=1,n={}){super(),n=Object.assign({generateMipmaps:!1,internalFormat:null,minFilter:Fn,depthBuffer:!0,stencilBuffer:!1,resolveColorBuffer:!0,resolveDepthBuffer:!0,resolveStencilBuffer:!0,storeMultisampledColorBuffer:!0,storeMultisampledDepthBuffer:!0,storeMultisampledStencilBuffer:!0,depthTexture:null,samples:0,count:1,depth:1,multiview:!1,useArrayDepthTexture:!1},n),this.isRenderTarget=!0,this.width=e,this.height=t,this.depth=n.depth,this.scissor=new en(0,0,e,t),this.scissorTest=!1,this.viewport=new en(0,0,e,t),this.textures=[];let s=n.count;for(let r=0;r<s;r++)this.textures[r]=new Un({width:e,height:t,depth:n.depth}),this.textures[r].isRenderTargetTexture=!0,this.textures[r].renderTarget=this;this._setTextureOptions(n),this.depthBuffer=n.depthBuffer,this.stencilBuffer=n.stencilBuffer,this.resolveColorBuffer=n.resolveColorBuffer,this.resolveDepthBuffer=n.resolveDepthBuffer,this.resolveStencilBuffer=n.resolveStencilBuffer,this.storeMultisampledColorBuffer=n.storeMultisampledColorBuffer,this.storeMultisampledDepthBuffer=n.storeMultisampledDepthBuffer,this.storeMultisampledStencilBuffer=n.storeMultisampledStencilBuffer,this._depthTexture=null,this.depthTexture=n.depthTexture,this.samples=n.samples,this.multiview=n.multiview,this.useArrayDepthTexture=n.useArrayDepthTexture}_setTextureOptions(e={}){let t={minFilter:Fn,generateMipmaps:!1,flipY:!1,internalFormat:null};e.mapping!==void 0&&(t.mapping=e.mapping),e.wrapS!==void 0&&(t.wrapS=e.wrapS),e.wrapT!==void 0&&(t.wrapT=e.wrapT),e.wrapR!==void 0&&(t.wrapR=e.wrapR),e.magFilter!==void 0&&(t.magFilter=e.magFilter),e.minFilter!==void 0&&(t.minFilter=e.minFilter),e.format!==void 0&&(t.format=e.format),e.type!==void 0&&(t.type=e.type),e.anisotropy!==void 0&&(t.anisotropy=e.anisotropy),e.colorSpace!==void 0&&(t.colorSpace=e.colorSpace),e.flipY!==void 0&&(t.flipY=e.flipY),e.generateMipmaps!==void 0&&(t.generateMipmaps=e.generateMipmaps),e.mipmapsAutoUpdate!==void 0&&(t.mipmapsAutoUpdate=e.mipmapsAutoUpdate),e.internalFormat!==void 0&&(t.internalFormat=e.internalFormat);for(let n=0;n<this.textures.length;n++)this.textures[n].setValues(t)}get texture(){return this.textures[0]}set texture(e){this.textures[0]=e}set depthTexture(e){this._depthTexture!==null&&this._depthTexture.renderTarget===this&&(this._depthTexture.renderTarget=null),e!==null&&e.renderTarget===null&&(e.renderTarget=this),this._depthTexture=e}get depthTexture(){return this._depthTexture}setSize(e,t,n=1){if(this.width!==e||this.height!==t||this.depth!==n){this.width=e,this.height=t,this.depth=n;for(let s=0,r=this.textures.length;s<r;s++)this.textures[s].image.width=e,this.textures[s].image.height=t,this.textures[s].image.depth=n,this.textures[s].isData3DTexture!==!0&&(this.textures[s].isArrayTexture=this.textures[s].image.depth>1);this.dispose()}this.viewport.set(0,0,e,t),this.scissor.set(0,0,e,t)}clone(){return new this.constructor().copy(this)}copy(e){this.width=e.width,this.height=e.height,this.depth=e.depth,this.scissor.copy(e.scissor),this.scissorTest=e.scissorTest,this.viewport.copy(e.viewport),this.textures.length=0;for(let t=0,n=e.textures.length;t<n;t++){this.textures[t]=e.textures[t].clone(),this.textures[t].isRenderTargetTexture=!0,this.textures[t].renderTarget=this;let s=Object.assign({},e.textures[t].image);this.textures[t].source=new lo(s)}if(this.depthBuffer=e.depthBuffer,this.stencilBuffer=e.stencilBuffer,this.resolveColorBuffer=e.resolveColorBuffer,this.resolveDepthBuffer=e.resolveDepthBuffer,this.resolveStencilBuffer=e.resolveStencilBuffer,this.storeMultisampledColorBuffer=e.storeMultisampledColorBuffer,this.storeMultisampledDepthBuffer=e.storeMultisampledDepthBuffer,this.storeMultisampledStencilBuffer=e.storeMultisampledStencilBuffer,e.depthTexture!==null)if(e.depthTexture.renderTarget===e){let t=e.depthTexture.clone();t.renderTarget=null,this.depthTexture=t}else this.depthTexture=e.depthTexture;else this.depthTexture=null;return this.samples=e.samples,this.multiview=e.multiview,this.useArrayDepthTexture=e.useArrayDepthTexture,this}dispose(){this.dispatchEvent({type:"dispose"})}},Kn=class extends Ol{constructor(e=1,t=1,n={}){super(e,t,n),this.isWebGLRenderTarget=!0}},ia=class extends Un{constructor(e=null,t=1,n=1,s=1){super(null),this.isDataArrayTexture=!0,this.image={data:e,width:t,height:n,depth:s},this.magFilter=an,this.minFilter=an,this.wrapR=ts,this.generateMipmaps=!1,this.flipY=!1,this.unpackAlignment=1,this.layerUpdates=new Set}copy(e){return super.copy(e),this.wrapR=e.wrapR,this}addLayerUpdate(e){this.layerUpdates.add(e)}clearLayerUpdates(){this.layerUpdates.clear()}};var Bl=class extends Un{constructor(e=null,t=1,n=1,s=1){super(null),this.isData3DTexture=!0,this.image={data:e,width:t,height:n,depth:s},this.magFilter=an,this.minFilter=an,this.wrapR=ts,this.generateMipmaps=!1,this.flipY=!1,this.unpackAlignment=1}copy(e){return super.copy(e),this.wrapR=e.wrapR,this}};var it=class i{static{this.prototype.isMatrix4=!0}constructor(e,t,n,s,r,o,a,l,c,h,u,d,f,g,v,p){this.elements=[1,0,0,0,0,1,0,0,0,0,1,0,0,0,0,1],e!==void 0&&this.set(e,t,n,s,r,o,a,l,c,h,u,d,f,g,v,p)}set(e,t,n,s,r,o,a,l,c,h,u,d,f,g,v,p){let m=this.elements;return m[0]=e,m[4]=t,m[8]=n,m[12]=s,m[1]=r,m[5]=o,m[9]=a,m[13]=l,m[2]=c,m[6]=h,m[10]=u,m[14]=d,m[3]=f,m[7]=g,m[11]=v,m[15]=p,this}identity(){return this.set(1,0,0,0,0,1,0,0,0,0,1,0,0,0,0,1),this}clone(){return new i().fromArray(this.elements)}copy(e){let t=this.elements,n=e.elements;return t[0]=n[0],t[1]=n[1],t[2]=n[2],t[3]=n[3],t[4]=n[4],t[5]=n[5],t[6]=n[6],t[7]=n[7],t[8]=n[8],t[9]=n[9],t[10]=n[10],t[11]=n[11],t[12]=n[12],t[13]=n[13],t[14]=n[14],t[15]=n[15],this}copyPosition(e){let t=this.elements,n=e.elements;return t[12]=n[12],t[13]=n[13],t[14]=n[14],this}setFromMatrix3(e){let t=e.elements;return this.set(t[0],t[3],t[6],0,t[1],t[4],t[7],0,t[2],t[5],t[8],0,0,0,0,1),this}extractBasis(e,t,n){return this.determinantAffine()===0?(e.set(1,0,0),t.set(0,1,0),n.set(0,0,1),this):(e.setFromMatrixColumn(this,0),t.setFromMatrixColumn(this,1),n.setFromMatrixColumn(this,2),this)}makeBasis(e,t,n){return this.set(e.x,t.x,n.x,0,e.y,t.y,n.y,0,e.z,t.z,n.z,0,0,0,0,1),this}extractRotation(e){if(e.determinantAffine()===0)return this.identity();let t=this.elements,n=e.elements,s=1/qr.setFromMatrixColumn(e,0).length(),r=1/qr.setFromMatrixColumn(e,1).length(),o=1/qr.setFromMatrixColumn(e,2).length();return t[0]=n[0]*s,t[1]=n[1]*s,t[2]=n[2]*s,t[3]=0,t[4]=n[4]*r,t[5]=n[5]*r,t[6]=n[6]*r,t[7]=0,t[8]=n[8]*o,t[9]=n[9]*o,t[10]=n[10]*o,t[11]=0,t[12]=0,t[13]=0,t[14]=0,t[15]=1,this}makeRotationFromEuler(e){let t=this.elements,n=e.x,s=e.y,r=e.z,o=Math.cos(n),a=Math.sin(n),l=Math.cos(s),c=Math.sin(s),h=Math.cos(r),u=Math.sin(r);if(e.order==="XYZ"){let d=o*h,f=o*u,g=a*h,v=a*u;t[0]=l*h,t[4]=-l*u,t[8]=c,t[1]=f+g*c,t[5]=d-v*c,t[9]=-a*l,t[2]=v-d*c,t[6]=g+f*c,t[10]=o*l}else if(e.order==="YXZ"){let d=l*h,f=l*u,g=c*h,v=c*u;t[0]=d+v*a,t[4]=g*a-f,t[8]=o*c,t[1]=o*u,t[5]=o*h,t[9]=-a,t[2]=f*a-g,t[6]=v+d*a,t[10]=o*l}else if(e.order==="ZXY"){let d=l*h,f=l*u,g=c*h,v=c*u;t[0]=d-v*a,t[4]=-o*u,t[8]=g+f*a,t[1]=f+g*a,t[5]=o*h,t[9]=v-d*a,t[2]=-o*c,t[6]=a,t[10]=o*l}else if(e.order==="ZYX"){let d=o*h,f=o*u,g=a*h,v=a*u;t[0]=l*h,t[4]=g*c-f,t[8]=d*c+v,t[1]=l*u,t[5]=v*c+d,t[9]=f*c-g,t[2]=-c,t[6]=a*l,t[10]=o*l}else if(e.order==="YZX"){let d=o*l,f=o*c,g=a*l,v=a*c;t[0]=l*h,t[4]=v-d*u,t[8]=g*u+f,t[1]=u,t[5]=o*h,t[9]=-a*h,t[2]=-c*h,t[6]=f*u+g,t[10]=d-v*u}else if(e.order==="XZY"){let d=o*l,f=o*c,g=a*l,v=a*c;t[0]=l*h,t[4]=-u,t[8]=c*h,t[1]=d*u+v,t[5]=o*h,t[9]=f*u-g,t[2]=g*u-f,t[6]=a*h,t[10]=v*u+d}return t[3]=0,t[7]=0,t[11]=0,t[12]=0,t[13]=0,t[14]=0,t[15]=1,this}makeRotationFromQuaternion(e){return this.compose(kv,e,zv)}lookAt(e,t,n){let s=this.elements;return ui.subVectors(e,t),ui.lengthSq()===0&&(ui.z=1),ui.normalize(),Ws.crossVectors(n,ui),Ws.lengthSq()===0&&(Math.abs(n.z)===1?ui.x+=1e-4:ui.z+=1e-4,ui.normalize(),Ws.crossVectors(n,ui)),Ws.normalize(),Qa.crossVectors(ui,Ws),s[0]=Ws.x,s[4]=Qa.x,s[8]=ui.x,s[1]=Ws.y,s[5]=Qa.y,s[9]=ui.y,s[2]=Ws.z,s[6]=Qa.z,s[10]=ui.z,this}multiply(e){return this.multiplyMatrices(this,e)}premultiply(e){return this.multiplyMatrices(e,this)}multiplyMatrices(e,t){let n=e.elements,s=t.elements,r=this.elements,o=n[0],a=n[4],l=n[8],c=n[12],h=n[1],u=n[5],d=n[9],f=n[13],g=n[2],v=n[6],p=n[10],m=n[14],y=n[3],R=n[7],b=n[11],A=n[15],E=s[0],_=s[4],T=s[8],O=s[12],I=s[1],L=s[5],H=s[9],V=s[13],N=s[2],X=s[6],$=s[10],W=s[14],ce=s[3],J=s[7],Q=s[11],se=s[15];return r[0]=o*E+a*I+l*N+c*ce,r[4]=o*_+a*L+l*X+c*J,r[8]=o*T+a*H+l*$+c*Q,r[12]=o*O+a*V+l*W+c*se,r[1]=h*E+u*I+d*N+f*ce,r[5]=h*_+u*L+d*X+f*J,r[9]=h*T+u*H+d*$+f*Q,r[13]=h*O+u*V+d*W+f*se,r[2]=g*E+v*I+p*N+m*ce,r[6]=g*_+v*L+p*X+m*J,r[10]=g*T+v*H+p*$+m*Q,r[14]=g*O+v*V+p*W+m*se,r[3]=y*E+R*I+b*N+A*ce,r[7]=y*_+R*L+b*X+A*J,r[11]=y*T+R*H+b*$+A*Q,r[15]=y*O+R*V+b*W+A*se,this}multiplyScalar(e){let t=this.elements;return t[0]*=e,t[4]*=e,t[8]*=e,t[12]*=e,t[1]*=e,t[5]*=e,t[9]*=e,t[13]*=e,t[2]*=e,t[6]*=e,t[10]*=e,t[14]*=e,t[3]*=e,t[7]*=e,t[11]*=e,t[15]*=e,this}determinant(){let e=this.elements,t=e[0],n=e[4],s=e[8],r=e[12],o=e[1],a=e[5],l=e[9],c=e[13],h=e[2],u=e[6],d=e[10],f=e[14],g=e[3],v=e[7],p=e[11],m=e[15],y=l*f-c*d,R=a*f-c*u,b=a*d-l*u,A=o*f-c*h,E=o*d-l*h,_=o*u-a*h;return t*(v*y-p*R+m*b)-n*(g*y-p*A+m*E)+s*(g*R-v*A+m*_)-r*(g*b-v*E+p*_)}determinantAffine(){let e=this.elements,t=e[0],n=e[4],s=e[8],r=e[1],o=e[5],a=e[9],l=e[2],c=e[6],h=e[10];return t*(o*h-a*c)-n*(r*h-a*l)+s*(r*c-o*l)}transpose(){let e=this.elements,t;return t=e[1],e[1]=e[4],e[4]=t,t=e[2],e[2]=e[8],e[8]=t,t=e[6],e[6]=e[9],e[9]=t,t=e[3],e[3]=e[12],e[12]=t,t=e[7],e[7]=e[13],e[13]=t,t=e[11],e[11]=e[14],e[14]=t,this}setPosition(e,t,n){let s=this.elements;return e.isVector3?(s[12]=e.x,s[13]=e.y,s[14]=e.z):(s[12]=e,s[13]=t,s[14]=n),this}invert(){let e=this.elements,t=e[0],n=e[1],s=e[2],r=e[3],o=e[4],a=e[5],l=e[6],c=e[7],h=e[8],u=e[9],d=e[10],f=e[11],g=e[12],v=e[13],p=e[14],m=e[15],y=t*a-n*o,R=t*l-s*o,b=t*c-r*o,A=n*l-s*a,E=n*c-r*a,_=s*c-r*l,T=h*v-u*g,O=h*p-d*g,I=h*m-f*g,L=u*p-d*v,H=u*m-f*v,V=d*m-f*p,N=y*V-R*H+b*L+A*I-E*O+_*T;if(N===0)return this.set(0,0,0,0,0,0,0,0,0,0,0,0,0,0,0,0);let X=1/N;return e[0]=(a*V-l*H+c*L)*X,e[1]=(s*H-n*V-r*L)*X,e[2]=(v*_-p*E+m*A)*X,e[3]=(d*E-u*_-f*A)*X,e[4]=(l*I-o*V-c*O)*X,e[5]=(t*V-s*I+r*O)*X,e[6]=(p*b-g*_-m*R)*X,e[7]=(h*_-d*b+f*R)*X,e[8]=(o*H-a*I+c*T)*X,e[9]=(n*I-t*H-r*T)*X,e[10]=(g*E-v*b+m*y)*X,e[11]=(u*b-h*E-f*y)*X,e[12]=(a*O-o*L-l*T)*X,e[13]=(t*L-n*O+s*T)*X,e[14]=(v*R-g*A-p*y)*X,e[15]=(h*A-u*R+d*y)*X,this}scale(e){let t=this.elements,n=e.x,s=e.y,r=e.z;return t[0]*=n,t[4]*=s,t[8]*=r,t[1]*=n,t[5]*=s,t[9]*=r,t[2]*=n,t[6]*=s,t[10]*=r,t[3]*=n,t[7]*=s,t[11]*=r,this}getMaxScaleOnAxis(){let e=this.elements,t=e[0]*e[0]+e[1]*e[1]+e[2]*e[2],n=e[4]*e[4]+e[5]*e[5]+e[6]*e[6],s=e[8]*e[8]+e[9]*e[9]+e[10]*e[10];return Math.sqrt(Math.max(t,n,s))}makeTranslation(e,t,n){return e.isVector3?this.set(1,0,0,e.x,0,1,0,e.y,0,0,1,e.z,0,0,0,1):this.set(1,0,0,e,0,1,0,t,0,0,1,n,0,0,0,1),this}makeRotationX(e){let t=Math.cos(e),n=Math.sin(e);return this.set(1,0,0,0,0,t,-n,0,0,n,t,0,0,0,0,1),this}makeRotationY(e){let t=Math.cos(e),n=Math.sin(e);return this.set(t,0,n,0,0,1,0,0,-n,0,t,0,0,0,0,1),this}makeRotationZ(e){let t=Math.cos(e),n=Math.sin(e);return this.set(t,-n,0,0,n,t,0,0,0,0,1,0,0,0,0,1),this}makeRotationAxis(e,t){let n=Math.cos(t),s=Math.sin(t),r=1-n,o=e.x,a=e.y,l=e.z,c=r*o,h=r*a;return this.set(c*o+n,c*a-s*l,c*l+s*a,0,c*a+s*l,h*a+n,h*l-s*o,0,c*l-s*a,h*l+s*o,r*l*l+n,0,0,0,0,1),this}makeScale(e,t,n){return this.set(e,0,0,0,0,t,0,0,0,0,n,0,0,0,0,1),this}makeShear(e,t,n,s,r,o){return this.set(1,n,r,0,e,1,o,0,t,s,1,0,0,0,0,1),this}compose(e,t,n){let s=this.elements,r=t._x,o=t._y,a=t._z,l=t._w,c=r+r,h=o+o,u=a+a,d=r*c,f=r*h,g=r*u,v=o*h,p=o*u,m=a*u,y=l*c,R=l*h,b=l*u,A=n.x,E=n.y,_=n.z;return s[0]=(1-(v+m))*A,s[1]=(f+b)*A,s[2]=(g-R)*A,s[3]=0,s[4]=(f-b)*E,s[5]=(1-(d+m))*E,s[6]=(p+y)*E,s[7]=0,s[8]=(g+R)*_,s[9]=(p-y)*_,s[10]=(1-(d+v))*_,s[11]=0,s[12]=e.x,s[13]=e.y,s[14]=e.z,s[15]=1,this}decompose(e,t,n){let s=this.elements;e.x=s[12],e.y=s[13],e.z=s[14];let r=this.determinantAffine();if(r===0)return n.set(1,1,1),t.identity(),this;let o=qr.set(s[0],s[1],s[2]).length(),a=qr.set(s[4],s[5],s[6]).length(),l=qr.set(s[8],s[9],s[10]).length();r<0&&(o=-o),Oi.copy(this);let c=1/o,h=1/a,u=1/l;return Oi.elements[0]*=c,Oi.elements[1]*=c,Oi.elements[2]*=c,Oi.elements[4]*=h,Oi.elements[5]*=h,Oi.elements[6]*=h,Oi.elements[8]*=u,Oi.elements[9]*=u,Oi.elements[10]*=u,t.setFromRotationMatrix(Oi),n.x=o,n.y=a,n.z=l,this}makePerspective(e,t,n,s,r,o,a=Ci,l=!1){let c=this.elements,h=2*r/(t-e),u=2*r/(n-s),d=(t+e)/(t-e),f=(n+s)/(n-s),g,v;if(l)g=r/(o-r),v=o*r/(o-r);else if(a===Ci)g=-(o+r)/(o-r),v=-2*o*r/(o-r);else if(a===ta)g=-o/(o-r),v=-o*r/(o-r);else throw new Error("THREE.Matrix4.makePerspective(): Invalid coordinate system: "+a);return c[0]=h,c[4]=0,c[8]=d,c[12]=0,c[1]=0,c[5]=u,c[9]=f,c[13]=0,c[2]=0,c[6]=0,c[10]=g,c[14]=v,c[3]=0,c[7]=0,c[11]=-1,c[15]=0,this}makeOrthographic(e,t,n,s,r,o,a=Ci,l=!1){let c=this.elements,h=2/(t-e),u=2/(n-s),d=-(t+e)/(t-e),f=-(n+s)/(n-s),g,v;if(l)g=1/(o-r),v=o/(o-r);else if(a===Ci)g=-2/(o-r),v=-(o+r)/(o-r);else if(a===ta)g=-1/(o-r),v=-r/(o-r);else throw new Error("THREE.Matrix4.makeOrthographic(): Invalid coordinate system: "+a);return c[0]=h,c[4]=0,c[8]=0,c[12]=d,c[1]=0,c[5]=u,c[9]=0,c[13]=f,c[2]=0,c[6]=0,c[10]=g,c[14]=v,c[3]=0,c[7]=0,c[11]=0,c[15]=1,this}equals(e){let t=this.elements,n=e.elements;for(let s=0;s<16;s++)if(t[s]!==n[s])return!1;return!0}fromArray(e,t=0){for(let n=0;n<16;n++)this.elements[n]=e[n+t];return this}toArray(e=[],t=0){let n=this.elements;return e[t]=n[0],e[t+1]=n[1],e[t+2]=n[2],e[t+3]=n[3],e[t+4]=n[4],e[t+5]=n[5],e[t+6]=n[6],e[t+7]=n[7],e[t+8]=n[8],e[t+9]=n[9],e[t+10]=n[10],e[t+11]=n[11],e[t+12]=n[12],e[t+13]=n[13],e[t+14]=n[14],e[t+15]=n[15],e}},qr=new k,Oi=new it,kv=new k(0,0,0),zv=new k(1,1,1),Ws=new k,Qa=new k,ui=new k,Zf=new it,Kf=new Vn,Js=class i{constructor(e=0,t=0,n=0,s=i.DEFAULT_ORDER){this.isEuler=!0,this._x=e,this._y=t,this._z=n,this._order=s}get x(){return this._x}set x(e){this._x=e,this._onChangeCallback()}get y(){return this._y}set y(e){this._y=e,this._onChangeCallback()}get z(){return this._z}set z(e){this._z=e,this._onChangeCallback()}get order(){return this._order}set order(e){this._order=e,this._onChangeCallback()}set(e,t,n,s=this._order){return this._x=e,this._y=t,this._z=n,this._order=s,this._onChangeCallback(),this}clone(){return new this.constructor(this._x,this._y,this._z,this._order)}copy(e){return this._x=e._x,this._y=e._y,this._z=e._z,this._order=e._order,this._onChangeCallback(),this}setFromRotationMatrix(e,t=this._order,n=!0){let s=e.elements,r=s[0],o=s[4],a=s[8],l=s[1],c=s[5],h=s[9],u=s[2],d=s[6],f=s[10];switch(t){case"XYZ":this._y=Math.asin(Mt(a,-1,1)),Math.abs(a)<.9999999?(this._x=Math.atan2(-h,f),this._z=Math.atan2(-o,r)):(this._x=Math.atan2(d,c),this._z=0);break;case"YXZ":this._x=Math.asin(-Mt(h,-1,1)),Math.abs(h)<.9999999?(this._y=Math.atan2(a,f),this._z=Math.atan2(l,c)):(this._y=Math.atan2(-u,r),this._z=0);break;case"ZXY":this._x=Math.asin(Mt(d,-1,1)),Math.abs(d)<.9999999?(this._y=Math.atan2(-u,f),this._z=Math.atan2(-o,c)):(this._y=0,this._z=Math.atan2(l,r));break;case"ZYX":this._y=Math.asin(-Mt(u,-1,1)),Math.abs(u)<.9999999?(this._x=Math.atan2(d,f),this._z=Math.atan2(l,r)):(this._x=0,this._z=Math.atan2(-o,c));break;case"YZX":this._z=Math.asin(Mt(l,-1,1)),Math.abs(l)<.9999999?(this._x=Math.atan2(-h,c),this._y=Math.atan2(-u,r)):(this._x=0,this._y=Math.atan2(a,f));break;case"XZY":this._z=Math.asin(-Mt(o,-1,1)),Math.abs(o)<.9999999?(this._x=Math.atan2(d,c),this._y=Math.atan2(a,r)):(this._x=Math.atan2(-h,f),this._y=0);break;default:$e("Euler: .setFromRotationMatrix() encountered an unknown order: "+t)}return this._order=t,n===!0&&this._onChangeCallback(),this}setFromQuaternion(e,t,n){return Zf.makeRotationFromQuaternion(e),this.setFromRotationMatrix(Zf,t,n)}setFromVector3(e,t=this._order){return this.set(e.x,e.y,e.z,t)}reorder(e){return Kf.setFromEuler(this),this.setFromQuaternion(Kf,e)}equals(e){return e._x===this._x&&e._y===this._y&&e._z===this._z&&e._order===this._order}fromArray(e){return this._x=e[0],this._y=e[1],this._z=e[2],e[3]!==void 0&&(this._order=e[3]),this._onChangeCallback(),this}toArray(e=[],t=0){return e[t]=this._x,e[t+1]=this._y,e[t+2]=this._z,e[t+3]=this._order,e}_onChange(e){return this._onChangeCallback=e,this}_onChangeCallback(){}*[Symbol.iterator](){yield this._x,yield this._y,yield this._z,yield this._order}};Js.DEFAULT_ORDER="XYZ";var sa=class{constructor(){this.mask=1}set(e){this.mask=(1<<e|0)>>>0}enable(e){this.mask|=1<<e|0}enableAll(){this.mask=-1}toggle(e){this.mask^=1<<e|0}disable(e){this.mask&=~(1<<e|0)}disableAll(){this.mask=0}test(e){return(this.mask&e.mask)!==0}isEnabled(e){return(this.mask&(1<<e|0))!==0}},Hv=0,Jf=new k,Yr=new Vn,gs=new it,el=new k,Xo=new k,Vv=new k,Gv=new Vn,jf=new k(1,0,0),Qf=new k(0,1,0),ep=new k(0,0,1),tp={type:"added"},Wv={type:"removed"},$r={type:"childadded",child:null},lu={type:"childremoved",child:null},ei=class i extends ns{constructor(){super(),this.isObject3D=!0,Object.defineProperty(this,"id",{value:Hv++}),this.uuid=Ta(),this.name="",this.type="Object3D",this.parent=null,this.children=[],this.up=i.DEFAULT_UP.clone();let e=new k,t=new Js,n=new Vn,s=new k(1,1,1);function r(){n.setFromEuler(t,!1)}function o(){t.setFromQuaternion(n,void 0,!1)}t._onChange(r),n._onChange(o),Object.defineProperties(this,{position:{configurable:!0,enumerable:!0,value:e},rotation:{configurable:!0,enumerable:!0,value:t},quaternion:{configurable:!0,enumerable:!0,value:n},scale:{configurable:!0,enumerable:!0,value:s},modelViewMatrix:{value:new it},normalMatrix:{value:new qe}}),this.matrix=new it,this.matrixWorld=new it,this.matrixAutoUpdate=i.DEFAULT_MATRIX_AUTO_UPDATE,this.matrixWorldAutoUpdate=i.DEFAULT_MATRIX_WORLD_AUTO_UPDATE,this.matrixWorldNeedsUpdate=!1,this.layers=new sa,this.visible=!0,this.castShadow=!1,this.receiveShadow=!1,this.frustumCulled=!0,this.renderOrder=0,this.animations=[],this.customDepthMaterial=void 0,this.customDistanceMaterial=void 0,this.static=!1,this.userData={},this.pivot=null}onBeforeShadow(){}onAfterShadow(){}onBeforeRender(){}onAfterRender(){}applyMatrix4(e){this.matrixAutoUpdate&&this.updateMatrix(),this.matrix.premultiply(e),this.matrix.decompose(this.position,this.quaternion,this.scale),this.pivot!==null&&this.position.copy(this.pivot).applyMatrix4(this.matrix).sub(this.pivot)}applyQuaternion(e){return this.quaternion.premultiply(e),this}setRotationFromAxisAngle(e,t){this.quaternion.setFromAxisAngle(e,t)}setRotationFromEuler(e){this.quaternion.setFromEuler(e,!0)}setRotationFromMatrix(e){this.quaternion.setFromRotationMatrix(e)}setRotationFromQuaternion(e){this.quaternion.copy(e)}rotateOnAxis(e,t){return Yr.setFromAxisAngle(e,t),this.quaternion.multiply(Yr),this}rotateOnWorldAxis(e,t){return Yr.setFromAxisAngle(e,t),this.quaternion.premultiply(Yr),this}rotateX(e){return this.rotateOnAxis(jf,e)}rotateY(e){return this.rotateOnAxis(Qf,e)}rotateZ(e){return this.rotateOnAxis(ep,e)}translateOnAxis(e,t){return Jf.copy(e).applyQuaternion(this.quaternion),this.position.add(Jf.multiplyScalar(t)),this}translateX(e){return this.translateOnAxis(jf,e)}translateY(e){return this.translateOnAxis(Qf,e)}translateZ(e){return this.translateOnAxis(ep,e)}localToWorld(e){return this.updateWorldMatrix(!0,!1),e.applyMatrix4(this.matrixWorld)}worldToLocal(e){return this.updateWorldMatrix(!0,!1),e.applyMatrix4(gs.copy(this.matrixWorld).invert())}lookAt(e,t,n){e.isVector3?el.copy(e):el.set(e,t,n);let s=this.parent;this.updateWorldMatrix(!0,!1),Xo.setFromMatrixPosition(this.matrixWorld),this.isCamera||this.isLight?gs.lookAt(Xo,el,this.up):gs.lookAt(el,Xo,this.up),this.quaternion.setFromRotationMatrix(gs),s&&(gs.extractRotation(s.matrixWorld),Yr.setFromRotationMatrix(gs),this.quaternion.premultiply(Yr.invert()))}add(e){if(arguments.length>1){for(let t=0;t<arguments.length;t++)this.add(arguments[t]);return this}return e===this?(Qe("Object3D.add: object can't be added as a child of itself.",e),this):(e&&e.isObject3D?(e.removeFromParent(),e.parent=this,this.children.push(e),e.dispatchEvent(tp),$r.child=e,this.dispatchEvent($r),$r.child=null):Qe("Object3D.add: object not an instance of THREE.Object3D.",e),this)}remove(e){if(arguments.length>1){for(let n=0;n<arguments.length;n++)this.remove(arguments[n]);return this}let t=this.children.indexOf(e);return t!==-1&&(e.parent=null,this.children.splice(t,1),e.dispatchEvent(Wv),lu.child=e,this.dispatchEvent(lu),lu.child=null),this}removeFromParent(){let e=this.parent;return e!==null&&e.remove(this),this}clear(){return this.remove(...this.children)}attach(e){return this.updateWorldMatrix(!0,!1),gs.copy(this.matrixWorld).invert(),e.parent!==null&&(e.parent.updateWorldMatrix(!0,!1),gs.multiply(e.parent.matrixWorld)),e.applyMatrix4(gs),e.removeFromParent(),e.parent=this,this.children.push(e),e.updateWorldMatrix(!1,!0),e.dispatchEvent(tp),$r.child=e,this.dispatchEvent($r),$r.child=null,this}getObjectById(e){return this.getObjectByProperty("id",e)}getObjectByName(e){return this.getObjectByProperty("name",e)}getObjectByProperty(e,t){if(this[e]===t)return this;for(let n=0,s=this.children.length;n<s;n++){let o=this.children[n].getObjectByProperty(e,t);if(o!==void 0)return o}}getObjectsByProperty(e,t,n=[]){this[e]===t&&n.push(this);let s=this.children;for(let r=0,o=s.length;r<o;r++)s[r].getObjectsByProperty(e,t,n);return n}getWorldPosition(e){return this.updateWorldMatrix(!0,!1),e.setFromMatrixPosition(this.matrixWorld)}getWorldQuaternion(e){return this.updateWorldMatrix(!0,!1),this.matrixWorld.decompose(Xo,e,Vv),e}getWorldScale(e){return this.updateWorldMatrix(!0,!1),this.matrixWorld.decompose(Xo,Gv,e),e}getWorldDirection(e){this.updateWorldMatrix(!0,!1);let t=this.matrixWorld.elements;return e.set(t[8],t[9],t[10]).normalize()}raycast(){}intersectsFrustum(){return!0}traverse(e){e(this);let t=this.children;for(let n=0,s=t.length;n<s;n++)t[n].traverse(e)}traverseVisible(e){if(this.visible===!1)return;e(this);let t=this.children;for(let n=0,s=t.length;n<s;n++)t[n].traverseVisible(e)}traverseAncestors(e){let t=this.parent;t!==null&&(e(t),t.traverseAncestors(e))}updateMatrix(){this.matrix.compose(this.position,this.quaternion,this.scale);let e=this.pivot;if(e!==null){let t=e.x,n=e.y,s=e.z,r=this.matrix.elements;r[12]+=t-r[0]*t-r[4]*n-r[8]*s,r[13]+=n-r[1]*t-r[5]*n-r[9]*s,r[14]+=s-r[2]*t-r[6]*n-r[10]*s}this.matrixWorldNeedsUpdate=!0}updateMatrixWorld(e){this.matrixAutoUpdate&&this.updateMatrix(),(this.matrixWorldNeedsUpdate||e)&&(this.matrixWorldAutoUpdate===!0&&(this.parent===null?this.matrixWorld.copy(this.matrix):this.matrixWorld.multiplyMatrices(this.parent.matrixWorld,this.matrix)),this.matrixWorldNeedsUpdate=!1,e=!0);let t=this.children;for(let n=0,s=t.length;n<s;n++)t[n].updateMatrixWorld(e)}updateWorldMatrix(e,t,n=!1){let s=this.parent;if(e===!0&&s!==null&&s.updateWorldMatrix(!0,!1),this.matrixAutoUpdate&&this.updateMatrix(),(this.matrixWorldNeedsUpdate||n)&&(this.matrixWorldAutoUpdate===!0&&(this.parent===null?this.matrixWorld.copy(this.matrix):this.matrixWorld.multiplyMatrices(this.parent.matrixWorld,this.matrix)),this.matrixWorldNeedsUpdate=!1,n=!0),t===!0){let r=this.children;for(let o=0,a=r.length;o<a;o++)r[o].updateWorldMatrix(!1,!0,n)}}toJSON(e){let t=e===void 0||typeof e=="string",n={};t&&(e={geometries:{},materials:{},textures:{},images:{},shapes:{},skeletons:{},animations:{},nodes:{}},n.metadata={version:4.7,type:"Object",generator:"Object3D.toJSON"});let s={};s.uuid=this.uuid,s.type=this.type,s.name=this.name,s.castShadow=this.castShadow,s.receiveShadow=this.receiveShadow,s.visible=this.visible,s.frustumCulled=this.frustumCulled,s.renderOrder=this.renderOrder,s.static=this.static,s.matrixAutoUpdate=this.matrixAutoUpdate,Object.keys(this.userData).length>0&&(s.userData=this.userData),s.layers=this.layers.mask,s.matrix=this.matrix.toArray(),s.up=this.up.toArray(),this.pivot!==null&&(s.pivot=this.pivot.toArray()),this.morphTargetDictionary!==void 0&&(s.morphTargetDictionary=Object.assign({},this.morphTargetDictionary)),this.morphTargetInfluences!==void 0&&(s.morphTargetInfluences=this.morphTargetInfluences.slice()),this.isInstancedMesh&&(s.type="InstancedMesh",s.count=this.count,s.instanceMatrix=this.instanceMatrix.toJSON(),this.instanceColor!==null&&(s.instanceColor=this.instanceColor.toJSON())),this.isBatchedMesh&&(s.type="BatchedMesh",s.perObjectFrustumCulled=this.perObjectFrustumCulled,s.sortObjects=this.sortObjects,s.drawRanges=this._drawRanges,s.reservedRanges=this._reservedRanges,s.geometryInfo=this._geometryInfo.map(a=>({...a,boundingBox:a.boundingBox?a.boundingBox.toJSON():void 0,boundingSphere:a.boundingSphere?a.boundingSphere.toJSON():void 0})),s.instanceInfo=this._instanceInfo.map(a=>({...a})),s.availableInstanceIds=this._availableInstanceIds.slice(),s.availableGeometryIds=this._availableGeometryIds.slice(),s.nextIndexStart=this._nextIndexStart,s.nextVertexStart=this._nextVertexStart,s.geometryCount=this._geometryCount,s.maxInstanceCount=this._maxInstanceCount,s.maxVertexCount=this._maxVertexCount,s.maxIndexCount=this._maxIndexCount,s.geometryInitialized=this._geometryInitialized,s.matricesTexture=this._matricesTexture.toJSON(e),s.indirectTexture=this._indirectTexture.toJSON(e),this._colorsTexture!==null&&(s.colorsTexture=this._colorsTexture.toJSON(e)),this.boundingSphere!==null&&(s.boundingSphere=this.boundingSphere.toJSON()),this.boundingBox!==null&&(s.boundingBox=this.boundingBox.toJSON()));function r(a,l){return a[l.uuid]===void 0&&(a[l.uuid]=l.toJSON(e)),l.uuid}if(this.isScene)this.background&&(this.background.isColor?s.background=this.background.toJSON():this.background.isTexture&&(s.background=this.background.toJSON(e).uuid)),this.environment&&this.environment.isTexture&&this.environment.isRenderTargetTexture!==!0&&(s.environment=this.environment.toJSON(e).uuid);else if(this.isMesh||this.isLine||this.isPoints){s.geometry=r(e.geometries,this.geometry);let a=this.geometry.parameters;if(a!==void 0&&a.shapes!==void 0){let l=a.shapes;if(Array.isArray(l))for(let c=0,h=l.length;c<h;c++){let u=l[c];r(e.shapes,u)}else r(e.shapes,l)}}if(this.isSkinnedMesh&&(s.bindMode=this.bindMode,s.bindMatrix=this.bindMatrix.toArray(),this.skeleton!==void 0&&(r(e.skeletons,this.skeleton),s.skeleton=this.skeleton.uuid)),this.material!==void 0)if(Array.isArray(this.material)){let a=[];for(let l=0,c=this.material.length;l<c;l++)a.push(r(e.materials,this.material[l]));s.material=a}else s.material=r(e.materials,this.material);if(this.children.length>0){s.children=[];for(let a=0;a<this.children.length;a++)s.children.push(this.children[a].toJSON(e).object)}if(this.animations.length>0){s.animations=[];for(let a=0;a<this.animations.length;a++){let l=this.animations[a];s.animations.push(r(e.animations,l))}}if(t){let a=o(e.geometries),l=o(e.materials),c=o(e.textures),h=o(e.images),u=o(e.shapes),d=o(e.skeletons),f=o(e.animations),g=o(e.nodes);a.length>0&&(n.geometries=a),l.length>0&&(n.materials=l),c.length>0&&(n.textures=c),h.length>0&&(n.images=h),u.length>0&&(n.shapes=u),d.length>0&&(n.skeletons=d),f.length>0&&(n.animations=f),g.length>0&&(n.nodes=g)}return n.object=s,n;function o(a){let l=[];for(let c in a){let h=a[c];delete h.metadata,l.push(h)}return l}}clone(e){return new this.constructor().copy(this,e)}copy(e,t=!0){if(this.name=e.name,this.up.copy(e.up),this.position.copy(e.position),this.rotation.order=e.rotation.order,this.quaternion.copy(e.quaternion),this.scale.copy(e.scale),this.pivot=e.pivot!==null?e.pivot.clone():null,this.matrix.copy(e.matrix),this.matrixWorld.copy(e.matrixWorld),this.matrixAutoUpdate=e.matrixAutoUpdate,this.matrixWorldAutoUpdate=e.matrixWorldAutoUpdate,this.matrixWorldNeedsUpdate=e.matrixWorldNeedsUpdate,this.layers.mask=e.layers.mask,this.visible=e.visible,this.castShadow=e.castShadow,this.receiveShadow=e.receiveShadow,this.frustumCulled=e.frustumCulled,this.renderOrder=e.renderOrder,this.static=e.static,this.animations=e.animations.slice(),this.userData=JSON.parse(JSON.stringify(e.userData)),t===!0)for(let n=0;n<e.children.length;n++){let s=e.children[n];this.add(s.clone())}return this}dispose(){this.dispatchEvent({type:"dispose"})}};ei.DEFAULT_UP=new k(0,1,0);ei.DEFAULT_MATRIX_AUTO_UPDATE=!0;ei.DEFAULT_MATRIX_WORLD_AUTO_UPDATE=!0;var Hn=class extends ei{constructor(){super(),this.isGroup=!0,this.type="Group"}},Xv={type:"move"},co=class{constructor(){this._targetRay=null,this._grip=null,this._hand=null}getHandSpace(){return this._hand===null&&(this._hand=new Hn,this._hand.matrixAutoUpdate=!1,this._hand.visible=!1,this._hand.joints={},this._hand.inputState={pinching:!1}),this._hand}getTargetRaySpace(){return this._targetRay===null&&(this._targetRay=new Hn,this._targetRay.matrixAutoUpdate=!1,this._targetRay.visible=!1,this._targetRay.hasLinearVelocity=!1,this._targetRay.linearVelocity=new k,this._targetRay.hasAngularVelocity=!1,this._targetRay.angularVelocity=new k),this._targetRay}getGripSpace(){return this._grip===null&&(this._grip=new Hn,this._grip.matrixAutoUpdate=!1,this._grip.visible=!1,this._grip.hasLinearVelocity=!1,this._grip.linearVelocity=new k,this._grip.hasAngularVelocity=!1,this._grip.angularVelocity=new k,this._grip.eventsEnabled=!1),this._grip}dispatchEvent(e){return this._targetRay!==null&&this._targetRay.dispatchEvent(e),this._grip!==null&&this._grip.dispatchEvent(e),this._hand!==null&&this._hand.dispatchEvent(e),this}connect(e){if(e&&e.hand){let t=this._hand;if(t)for(let n of e.hand.values())this._getHandJoint(t,n)}return this.dispatchEvent({type:"connected",data:e}),this}disconnect(e){return this.dispatchEvent({type:"disconnected",data:e}),this._targetRay!==null&&(this._targetRay.visible=!1),this._grip!==null&&(this._grip.visible=!1),this._hand!==null&&(this._hand.visible=!1),this}update(e,t,n){let s=null,r=null,o=null,a=this._targetRay,l=this._grip,c=this._hand;if(e&&t.session.visibilityState!=="visible-blurred"){if(c&&e.hand){o=!0;for(let v of e.hand.values()){let p=t.getJointPose(v,n),m=this._getHandJoint(c,v);p!==null&&(m.matrix.fromArray(p.transform.matrix),m.matrix.decompose(m.position,m.quaternion,m.scale),m.matrixWorldNeedsUpdate=!0,m.jointRadius=p.radius),m.visible=p!==null}let h=c.joints["index-finger-tip"],u=c.joints["thumb-tip"],d=h.position.distanceTo(u.position),f=.02,g=.005;c.inputState.pinching&&d>f+g?(c.inputState.pinching=!1,this.dispatchEvent({type:"pinchend",handedness:e.handedness,target:this})):!c.inputState.pinching&&d<=f-g&&(c.inputState.pinching=!0,this.dispatchEvent({type:"pinchstart",handedness:e.handedness,target:this}))}else l!==null&&e.gripSpace&&(r=t.getPose(e.gripSpace,n),r!==null&&(l.matrix.fromArray(r.transform.matrix),l.matrix.decompose(l.position,l.quaternion,l.scale),l.matrixWorldNeedsUpdate=!0,r.linearVelocity?(l.hasLinearVelocity=!0,l.linearVelocity.copy(r.linearVelocity)):l.hasLinearVelocity=!1,r.angularVelocity?(l.hasAngularVelocity=!0,l.angularVelocity.copy(r.angularVelocity)):l.hasAngularVelocity=!1,l.eventsEnabled&&l.dispatchEvent({type:"gripUpdated",data:e,target:this})));a!==null&&(s=t.getPose(e.targetRaySpace,n),s===null&&r!==null&&(s=r),s!==null&&(a.matrix.fromArray(s.transform.matrix),a.matrix.decompose(a.position,a.quaternion,a.scale),a.matrixWorldNeedsUpdate=!0,s.linearVelocity?(a.hasLinearVelocity=!0,a.linearVelocity.copy(s.linearVelocity)):a.hasLinearVelocity=!1,s.angularVelocity?(a.hasAngularVelocity=!0,a.angularVelocity.copy(s.angularVelocity)):a.hasAngularVelocity=!1,this.dispatchEvent(Xv)))}return a!==null&&(a.visible=s!==null),l!==null&&(l.visible=r!==null),c!==null&&(c.visible=o!==null),this}_getHandJoint(e,t){if(e.joints[t.jointName]===void 0){let n=new Hn;n.matrixAutoUpdate=!1,n.visible=!1,e.joints[t.jointName]=n,e.add(n)}return e.joints[t.jointName]}},sm={aliceblue:15792383,antiquewhite:16444375,aqua:65535,aquamarine:8388564,azure:15794175,beige:16119260,bisque:16770244,black:0,blanchedalmond:16772045,blue:255,blueviolet:9055202,brown:10824234,burlywood:14596231,cadetblue:6266528,chartreuse:8388352,chocolate:13789470,coral:16744272,cornflowerblue:6591981,cornsilk:16775388,crimson:14423100,cyan:65535,darkblue:139,darkcyan:35723,darkgoldenrod:12092939,darkgray:11119017,darkgreen:25600,darkgrey:11119017,darkkhaki:12433259,darkmagenta:9109643,darkolivegreen:5597999,darkorange:16747520,darkorchid:10040012,darkred:9109504,darksalmon:15308410,darkseagreen:9419919,darkslateblue:4734347,darkslategray:3100495,darkslategrey:3100495,darkturquoise:52945,darkviolet:9699539,deeppink:16716947,deepskyblue:49151,dimgray:6908265,dimgrey:6908265,dodgerblue:2003199,firebrick:11674146,floralwhite:16775920,forestgreen:2263842,fuchsia:16711935,gainsboro:14474460,ghostwhite:16316671,gold:16766720,goldenrod:14329120,gray:8421504,green:32768,greenyellow:11403055,grey:8421504,honeydew:15794160,hotpink:16738740,indianred:13458524,indigo:4915330,ivory:16777200,khaki:15787660,lavender:15132410,lavenderblush:16773365,lawngreen:8190976,lemonchiffon:16775885,lightblue:11393254,lightcoral:15761536,lightcyan:14745599,lightgoldenrodyellow:16448210,lightgray:13882323,lightgreen:9498256,lightgrey:13882323,lightpink:16758465,lightsalmon:16752762,lightseagreen:2142890,lightskyblue:8900346,lightslategray:7833753,lightslategrey:7833753,lightsteelblue:11584734,lightyellow:16777184,lime:65280,limegreen:3329330,linen:16445670,magenta:16711935,maroon:8388608,mediumaquamarine:6737322,mediumblue:205,mediumorchid:12211667,mediumpurple:9662683,mediumseagreen:3978097,mediumslateblue:8087790,mediumspringgreen:64154,mediumturquoise:4772300,mediumvioletred:13047173,midnightblue:1644912,mintcream:16121850,mistyrose:16770273,moccasin:16770229,navajowhite:16768685,navy:128,oldlace:16643558,olive:8421376,olivedrab:7048739,orange:16753920,orangered:16729344,orchid:14315734,palegoldenrod:15657130,palegreen:10025880,paleturquoise:11529966,palevioletred:14381203,papayawhip:16773077,peachpuff:16767673,peru:13468991,pink:16761035,plum:14524637,powderblue:11591910,purple:8388736,rebeccapurple:6697881,red:16711680,rosybrown:12357519,royalblue:4286945,saddlebrown:9127187,salmon:16416882,sandybrown:16032864,seagreen:3050327,seashell:16774638,sienna:10506797,silver:12632256,skyblue:8900331,slateblue:6970061,slategray:7372944,slategrey:7372944,snow:16775930,springgreen:65407,steelblue:4620980,tan:13808780,teal:32896,thistle:14204888,tomato:16737095,turquoise:4251856,violet:15631086,wheat:16113331,white:16777215,whitesmoke:16119285,yellow:16776960,yellowgreen:10145074},Xs={h:0,s:0,l:0},tl={h:0,s:0,l:0};function cu(i,e,t){return t<0&&(t+=1),t>1&&(t-=1),t<1/6?i+(e-i)*6*t:t<1/2?e:t<2/3?i+(e-i)*6*(2/3-t):i}var xt=class{constructor(e,t,n){return this.isColor=!0,this.r=1,this.g=1,this.b=1,this.set(e,t,n)}set(e,t,n){if(t===void 0&&n===void 0){let s=e;s&&s.isColor?this.copy(s):typeof s=="number"?this.setHex(s):typeof s=="string"&&this.setStyle(s)}else this.setRGB(e,t,n);return this}setScalar(e){return this.r=e,this.g=e,this.b=e,this}setHex(e,t=fi){return e=Math.floor(e),this.r=(e>>16&255)/255,this.g=(e>>8&255)/255,this.b=(e&255)/255,gt.colorSpaceToWorking(this,t),this}setRGB(e,t,n,s=gt.workingColorSpace){return this.r=e,this.g=t,this.b=n,gt.colorSpaceToWorking(this,s),this}setHSL(e,t,n,s=gt.workingColorSpace){if(e=Dv(e,1),t=Mt(t,0,1),n=Mt(n,0,1),t===0)this.r=this.g=this.b=n;else{let r=n<=.5?n*(1+t):n+t-n*t,o=2*n-r;this.r=cu(o,r,e+1/3),this.g=cu(o,r,e),this.b=cu(o,r,e-1/3)}return gt.colorSpaceToWorking(this,s),this}setStyle(e,t=fi){function n(r){r!==void 0&&parseFloat(r)<1&&$e("Color: Alpha component of "+e+" will be ignored.")}let s;if(s=/^(\w+)\(([^\)]*)\)/.exec(e)){let r,o=s[1],a=s[2];switch(o){case"rgb":case"rgba":if(r=/^\s*(\d+)\s*,\s*(\d+)\s*,\s*(\d+)\s*(?:,\s*(\d+(?:\.\d+)?|\.\d+)\s*)?$/.exec(a))return n(r[4]),this.setRGB(Math.min(255,parseInt(r[1],10))/255,Math.min(255,parseInt(r[2],10))/255,Math.min(255,parseInt(r[3],10))/255,t);if(r=/^\s*(\d+(?:\.\d+)?|\.\d+)\%\s*,\s*(\d+(?:\.\d+)?|\.\d+)\%\s*,\s*(\d+(?:\.\d+)?|\.\d+)\%\s*(?:,\s*(\d+(?:\.\d+)?|\.\d+)\s*)?$/.exec(a))return n(r[4]),this.setRGB(Math.min(100,parseFloat(r[1]))/100,Math.min(100,parseFloat(r[2]))/100,Math.min(100,parseFloat(r[3]))/100,t);break;case"hsl":case"hsla":if(r=/^\s*([+-]?(?:\d+(?:\.\d+)?|\.\d+))\s*,\s*(\d+(?:\.\d+)?|\.\d+)\%\s*,\s*(\d+(?:\.\d+)?|\.\d+)\%\s*(?:,\s*(\d+(?:\.\d+)?|\.\d+)\s*)?$/.exec(a))return n(r[4]),this.setHSL(parseFloat(r[1])/360,parseFloat(r[2])/100,parseFloat(r[3])/100,t);break;default:$e("Color: Unknown color model "+e)}}else if(s=/^\#([A-Fa-f\d]+)$/.exec(e)){let r=s[1],o=r.length;if(o===3)return this.setRGB(parseInt(r.charAt(0),16)/15,parseInt(r.charAt(1),16)/15,parseInt(r.charAt(2),16)/15,t);if(o===6)return this.setHex(parseInt(r,16),t);$e("Color: Invalid hex color "+e)}else if(e&&e.length>0)return this.setColorName(e,t);return this}setColorName(e,t=fi){let n=sm[e.toLowerCase()];return n!==void 0?this.setHex(n,t):$e("Color: Unknown color "+e),this}clone(){return new this.constructor(this.r,this.g,this.b)}copy(e){return this.r=e.r,this.g=e.g,this.b=e.b,this}copySRGBToLinear(e){return this.r=bs(e.r),this.g=bs(e.g),this.b=bs(e.b),this}copyLinearToSRGB(e){return this.r=ro(e.r),this.g=ro(e.g),this.b=ro(e.b),this}convertSRGBToLinear(){return this.copySRGBToLinear(this),this}convertLinearToSRGB(){return this.copyLinearToSRGB(this),this}getHex(e=fi){return gt.workingToColorSpace(zn.copy(this),e),Math.round(Mt(zn.r*255,0,255))*65536+Math.round(Mt(zn.g*255,0,255))*256+Math.round(Mt(zn.b*255,0,255))}getHexString(e=fi){return("000000"+this.getHex(e).toString(16)).slice(-6)}getHSL(e,t=gt.workingColorSpace){gt.workingToColorSpace(zn.copy(this),t);let n=zn.r,s=zn.g,r=zn.b,o=Math.max(n,s,r),a=Math.min(n,s,r),l,c,h=(a+o)/2;if(a===o)l=0,c=0;else{let u=o-a;switch(c=h<=.5?u/(o+a):u/(2-o-a),o){case n:l=(s-r)/u+(s<r?6:0);break;case s:l=(r-n)/u+2;break;case r:l=(n-s)/u+4;break}l/=6}return e.h=l,e.s=c,e.l=h,e}getRGB(e,t=gt.workingColorSpace){return gt.workingToColorSpace(zn.copy(this),t),e.r=zn.r,e.g=zn.g,e.b=zn.b,e}getStyle(e=fi){gt.workingToColorSpace(zn.copy(this),e);let t=zn.r,n=zn.g,s=zn.b;return e!==fi?`color(${e} ${t.toFixed(3)} ${n.toFixed(3)} ${s.toFixed(3)})`:`rgb(${Math.round(t*255)},${Math.round(n*255)},${Math.round(s*255)})`}offsetHSL(e,t,n){return this.getHSL(Xs),this.setHSL(Xs.h+e,Xs.s+t,Xs.l+n)}add(e){return this.r+=e.r,this.g+=e.g,this.b+=e.b,this}addColors(e,t){return this.r=e.r+t.r,this.g=e.g+t.g,this.b=e.b+t.b,this}addScalar(e){return this.r+=e,this.g+=e,this.b+=e,this}sub(e){return this.r=Math.max(0,this.r-e.r),this.g=Math.max(0,this.g-e.g),this.b=Math.max(0,this.b-e.b),this}multiply(e){return this.r*=e.r,this.g*=e.g,this.b*=e.b,this}multiplyScalar(e){return this.r*=e,this.g*=e,this.b*=e,this}lerp(e,t){return this.r+=(e.r-this.r)*t,this.g+=(e.g-this.g)*t,this.b+=(e.b-this.b)*t,this}lerpColors(e,t,n){return this.r=e.r+(t.r-e.r)*n,this.g=e.g+(t.g-e.g)*n,this.b=e.b+(t.b-e.b)*n,this}lerpHSL(e,t){this.getHSL(Xs),e.getHSL(tl);let n=iu(Xs.h,tl.h,t),s=iu(Xs.s,tl.s,t),r=iu(Xs.l,tl.l,t);return this.setHSL(n,s,r),this}setFromVector3(e){return this.r=e.x,this.g=e.y,this.b=e.z,this}applyMatrix3(e){let t=this.r,n=this.g,s=this.b,r=e.elements;return this.r=r[0]*t+r[3]*n+r[6]*s,this.g=r[1]*t+r[4]*n+r[7]*s,this.b=r[2]*t+r[5]*n+r[8]*s,this}equals(e){return e.r===this.r&&e.g===this.g&&e.b===this.b}fromArray(e,t=0){return this.r=e[t],this.g=e[t+1],this.b=e[t+2],this}toArray(e=[],t=0){return e[t]=this.r,e[t+1]=this.g,e[t+2]=this.b,e}fromBufferAttribute(e,t){return this.r=e.getX(t),this.g=e.getY(t),this.b=e.getZ(t),this}toJSON(){return this.getHex()}*[Symbol.iterator](){yield this.r,yield this.g,yield this.b}},zn=new xt;xt.NAMES=sm;var gr=class extends ei{constructor(){super(),this.isScene=!0,this.type="Scene",this.background=null,this.environment=null,this.fog=null,this.backgroundBlurriness=0,this.backgroundIntensity=1,this.backgroundRotation=new Js,this.environmentIntensity=1,this.environmentRotation=new Js,this.overrideMaterial=null,typeof __THREE_DEVTOOLS__<"u"&&__THREE_DEVTOOLS__.dispatchEvent(new CustomEvent("observe",{detail:this}))}copy(e,t){return super.copy(e,t),this.background=e.background!==null?e.background.clone():null,this.environment=e.environment!==null?e.environment.clone():null,this.fog=e.fog!==null?e.fog.clone():null,this.backgroundBlurriness=e.backgroundBlurriness,this.backgroundIntensity=e.backgroundIntensity,this.backgroundRotation.copy(e.backgroundRotation),this.environmentIntensity=e.environmentIntensity,this.environmentRotation.copy(e.environmentRotation),this.overrideMaterial=e.overrideMaterial!==null?e.overrideMaterial.clone():null,this.matrixAutoUpdate=e.matrixAutoUpdate,this}toJSON(e){let t=super.toJSON(e);return this.fog!==null&&(t.object.fog=this.fog.toJSON()),t.object.backgroundBlurriness=this.backgroundBlurriness,t.object.backgroundIntensity=this.backgroundIntensity,t.object.backgroundRotation=this.backgroundRotation.toArray(),t.object.environmentIntensity=this.environmentIntensity,t.object.environmentRotation=this.environmentRotation.toArray(),t}},Bi=new k,vs=new k,hu=new k,_s=new k,Zr=new k,Kr=new k,np=new k,uu=new k,du=new k,fu=new k,pu=new en,mu=new en,gu=new en,Zs=class i{constructor(e=new k,t=new k,n=new k){this.a=e,this.b=t,this.c=n}static getNormal(e,t,n,s){s.subVectors(n,t),Bi.subVectors(e,t),s.cross(Bi);let r=s.lengthSq();return r>0?s.multiplyScalar(1/Math.sqrt(r)):s.set(0,0,0)}static getBarycoord(e,t,n,s,r){Bi.subVectors(s,t),vs.subVectors(n,t),hu.subVectors(e,t);let o=Bi.dot(Bi),a=Bi.dot(vs),l=Bi.dot(hu),c=vs.dot(vs),h=vs.dot(hu),u=o*c-a*a;if(u===0)return r.set(0,0,0),null;let d=1/u,f=(c*l-a*h)*d,g=(o*h-a*l)*d;return r.set(1-f-g,g,f)}static containsPoint(e,t,n,s){return this.getBarycoord(e,t,n,s,_s)===null?!1:_s.x>=0&&_s.y>=0&&_s.x+_s.y<=1}static getInterpolation(e,t,n,s,r,o,a,l){return this.getBarycoord(e,t,n,s,_s)===null?(l.x=0,l.y=0,"z"in l&&(l.z=0),"w"in l&&(l.w=0),null):(l.setScalar(0),l.addScaledVector(r,_s.x),l.addScaledVector(o,_s.y),l.addScaledVector(a,_s.z),l)}static getInterpolatedAttribute(e,t,n,s,r,o){return pu.setScalar(0),mu.setScalar(0),gu.setScalar(0),pu.fromBufferAttribute(e,t),mu.fromBufferAttribute(e,n),gu.fromBufferAttribute(e,s),o.setScalar(0),o.addScaledVector(pu,r.x),o.addScaledVector(mu,r.y),o.addScaledVector(gu,r.z),o}static isFrontFacing(e,t,n,s){return Bi.subVectors(n,t),vs.subVectors(e,t),Bi.cross(vs).dot(s)<0}set(e,t,n){return this.a.copy(e),this.b.copy(t),this.c.copy(n),this}setFromPointsAndIndices(e,t,n,s){return this.a.copy(e[t]),this.b.copy(e[n]),this.c.copy(e[s]),this}setFromAttributeAndIndices(e,t,n,s){return this.a.fromBufferAttribute(e,t),this.b.fromBufferAttribute(e,n),this.c.fromBufferAttribute(e,s),this}clone(){return new this.constructor().copy(this)}copy(e){return this.a.copy(e.a),this.b.copy(e.b),this.c.copy(e.c),this}getArea(){return Bi.subVectors(this.c,this.b),vs.subVectors(this.a,this.b),Bi.cross(vs).length()*.5}getMidpoint(e){return e.addVectors(this.a,this.b).add(this.c).multiplyScalar(1/3)}getNormal(e){return i.getNormal(this.a,this.b,this.c,e)}getPlane(e){return e.setFromCoplanarPoints(this.a,this.b,this.c)}getBarycoord(e,t){return i.getBarycoord(e,this.a,this.b,this.c,t)}getInterpolation(e,t,n,s,r){return i.getInterpolation(e,this.a,this.b,this.c,t,n,s,r)}containsPoint(e){return i.containsPoint(e,this.a,this.b,this.c)}isFrontFacing(e){return i.isFrontFacing(this.a,this.b,this.c,e)}intersectsBox(e){return e.intersectsTriangle(this)}closestPointToPoint(e,t){let n=this.a,s=this.b,r=this.c,o,a;Zr.subVectors(s,n),Kr.subVectors(r,n),uu.subVectors(e,n);let l=Zr.dot(uu),c=Kr.dot(uu);if(l<=0&&c<=0)return t.copy(n);du.subVectors(e,s);let h=Zr.dot(du),u=Kr.dot(du);if(h>=0&&u<=h)return t.copy(s);let d=l*u-h*c;if(d<=0&&l>=0&&h<=0&&l-h>0)return o=l/(l-h),t.copy(n).addScaledVector(Zr,o);fu.subVectors(e,r);let f=Zr.dot(fu),g=Kr.dot(fu);if(g>=0&&f<=g)return t.copy(r);let v=f*c-l*g;if(v<=0&&c>=0&&g<=0)return a=c/(c-g),t.copy(n).addScaledVector(Kr,a);let p=h*g-f*u;if(p<=0&&u-h>=0&&f-g>=0)return np.subVectors(r,s),a=(u-h)/(u-h+(f-g)),t.copy(s).addScaledVector(np,a);let m=1/(p+v+d);return o=v*m,a=d*m,t.copy(n).addScaledVector(Zr,o).addScaledVector(Kr,a)}equals(e){return e.a.equals(this.a)&&e.b.equals(this.b)&&e.c.equals(this.c)}},Gn=class{constructor(e=new k(1/0,1/0,1/0),t=new k(-1/0,-1/0,-1/0)){this.isBox3=!0,this.min=e,this.max=t}set(e,t){return this.min.copy(e),this.max.copy(t),this}setFromArray(e){this.makeEmpty();for(let t=0,n=e.length;t<n;t+=3)this.expandByPoint(ki.fromArray(e,t));return this}setFromBufferAttribute(e){this.makeEmpty();for(let t=0,n=e.count;t<n;t++)this.expandByPoint(ki.fromBufferAttribute(e,t));return this}setFromPoints(e){this.makeEmpty();for(let t=0,n=e.length;t<n;t++)this.expandByPoint(e[t]);return this}setFromCenterAndSize(e,t){let n=ki.copy(t).multiplyScalar(.5);return this.min.copy(e).sub(n),this.max.copy(e).add(n),this}setFromObject(e,t=!1){return this.makeEmpty(),this.expandByObject(e,t)}clone(){return new this.constructor().copy(this)}copy(e){return this.min.copy(e.min),this.max.copy(e.max),this}makeEmpty(){return this.min.x=this.min.y=this.min.z=1/0,this.max.x=this.max.y=this.max.z=-1/0,this}isEmpty(){return this.max.x<this.min.x||this.max.y<this.min.y||this.max.z<this.min.z}getCenter(e){return this.isEmpty()?e.set(0,0,0):e.addVectors(this.min,this.max).multiplyScalar(.5)}getSize(e){return this.isEmpty()?e.set(0,0,0):e.subVectors(this.max,this.min)}expandByPoint(e){return this.min.min(e),this.max.max(e),this}expandByVector(e){return this.min.sub(e),this.max.add(e),this}expandByScalar(e){return this.min.addScalar(-e),this.max.addScalar(e),this}expandByObject(e,t=!1){e.updateWorldMatrix(!1,!1);let n=e.geometry;if(n!==void 0){let r=n.getAttribute("position");if(t===!0&&r!==void 0&&e.isInstancedMesh!==!0&&e.isBatchedMesh!==!0)for(let o=0,a=r.count;o<a;o++)e.isMesh===!0?e.getVertexPosition(o,ki):ki.fromBufferAttribute(r,o),ki.applyMatrix4(e.matrixWorld),this.expandByPoint(ki);else e.boundingBox!==void 0?(e.boundingBox===null&&e.computeBoundingBox(),nl.copy(e.boundingBox)):(n.boundingBox===null&&n.computeBoundingBox(),nl.copy(n.boundingBox)),nl.applyMatrix4(e.matrixWorld),this.union(nl)}let s=e.children;for(let r=0,o=s.length;r<o;r++)this.expandByObject(s[r],t);return this}containsPoint(e){return e.x>=this.min.x&&e.x<=this.max.x&&e.y>=this.min.y&&e.y<=this.max.y&&e.z>=this.min.z&&e.z<=this.max.z}containsBox(e){return this.min.x<=e.min.x&&e.max.x<=this.max.x&&this.min.y<=e.min.y&&e.max.y<=this.max.y&&this.min.z<=e.min.z&&e.max.z<=this.max.z}getParameter(e,t){return t.set((e.x-this.min.x)/(this.max.x-this.min.x),(e.y-this.min.y)/(this.max.y-this.min.y),(e.z-this.min.z)/(this.max.z-this.min.z))}intersectsBox(e){return e.max.x>=this.min.x&&e.min.x<=this.max.x&&e.max.y>=this.min.y&&e.min.y<=this.max.y&&e.max.z>=this.min.z&&e.min.z<=this.max.z}intersectsSphere(e){return this.clampPoint(e.center,ki),ki.distanceToSquared(e.center)<=e.radius*e.radius}intersectsPlane(e){let t,n;return e.normal.x>0?(t=e.normal.x*this.min.x,n=e.normal.x*this.max.x):(t=e.normal.x*this.max.x,n=e.normal.x*this.min.x),e.normal.y>0?(t+=e.normal.y*this.min.y,n+=e.normal.y*this.max.y):(t+=e.normal.y*this.max.y,n+=e.normal.y*this.min.y),e.normal.z>0?(t+=e.normal.z*this.min.z,n+=e.normal.z*this.max.z):(t+=e.normal.z*this.max.z,n+=e.normal.z*this.min.z),t<=-e.constant&&n>=-e.constant}intersectsTriangle(e){if(this.isEmpty())return!1;this.getCenter(qo),il.subVectors(this.max,qo),Jr.subVectors(e.a,qo),jr.subVectors(e.b,qo),Qr.subVectors(e.c,qo),qs.subVectors(jr,Jr),Ys.subVectors(Qr,jr),ur.subVectors(Jr,Qr);let t=[0,-qs.z,qs.y,0,-Ys.z,Ys.y,0,-ur.z,ur.y,qs.z,0,-qs.x,Ys.z,0,-Ys.x,ur.z,0,-ur.x,-qs.y,qs.x,0,-Ys.y,Ys.x,0,-ur.y,ur.x,0];return!vu(t,Jr,jr,Qr,il)||(t=[1,0,0,0,1,0,0,0,1],!vu(t,Jr,jr,Qr,il))?!1:(sl.crossVectors(qs,Ys),t=[sl.x,sl.y,sl.z],vu(t,Jr,jr,Qr,il))}clampPoint(e,t){return t.copy(e).clamp(this.min,this.max)}distanceToPoint(e){return this.clampPoint(e,ki).distanceTo(e)}getBoundingSphere(e){return this.isEmpty()?e.makeEmpty():(this.getCenter(e.center),e.radius=this.getSize(ki).length()*.5),e}intersect(e){return this.min.max(e.min),this.max.min(e.max),this.isEmpty()&&this.makeEmpty(),this}union(e){return this.min.min(e.min),this.max.max(e.max),this}applyMatrix4(e){return this.isEmpty()?this:(xs[0].set(this.min.x,this.min.y,this.min.z).applyMatrix4(e),xs[1].set(this.min.x,this.min.y,this.max.z).applyMatrix4(e),xs[2].set(this.min.x,this.max.y,this.min.z).applyMatrix4(e),xs[3].set(this.min.x,this.max.y,this.max.z).applyMatrix4(e),xs[4].set(this.max.x,this.min.y,this.min.z).applyMatrix4(e),xs[5].set(this.max.x,this.min.y,this.max.z).applyMatrix4(e),xs[6].set(this.max.x,this.max.y,this.min.z).applyMatrix4(e),xs[7].set(this.max.x,this.max.y,this.max.z).applyMatrix4(e),this.setFromPoints(xs),this)}translate(e){return this.min.add(e),this.max.add(e),this}equals(e){return e.min.equals(this.min)&&e.max.equals(this.max)}toJSON(){return{min:this.min.toArray(),max:this.max.toArray()}}fromJSON(e){return this.min.fromArray(e.min),this.max.fromArray(e.max),this}},xs=[new k,new k,new k,new k,new k,new k,new k,new k],ki=new k,nl=new Gn,Jr=new k,jr=new k,Qr=new k,qs=new k,Ys=new k,ur=new k,qo=new k,il=new k,sl=new k,dr=new k;function vu(i,e,t,n,s){for(let r=0,o=i.length-3;r<=o;r+=3){dr.fromArray(i,r);let a=s.x*Math.abs(dr.x)+s.y*Math.abs(dr.y)+s.z*Math.abs(dr.z),l=e.dot(dr),c=t.dot(dr),h=n.dot(dr);if(Math.max(-Math.max(l,c,h),Math.min(l,c,h))>a)return!1}return!0}var vn=new k,rl=new vt,qv=0,Nn=class extends ns{constructor(e,t,n=!1){if(super(),Array.isArray(e))throw new TypeError("THREE.BufferAttribute: array should be a Typed Array.");this.isBufferAttribute=!0,Object.defineProperty(this,"id",{value:qv++}),this.name="",this.array=e,this.itemSize=t,this.count=e!==void 0?e.length/t:0,this.normalized=n,this.usage=jp,this.updateRanges=[],this.gpuType=ti,this.version=0,this._normalizationScale=e!==void 0?nd(e):void 0}onUploadCallback(){}set needsUpdate(e){e===!0&&this.version++}setUsage(e){return this.usage=e,this}addUpdateRange(e,t){this.updateRanges.push({start:e,count:t})}clearUpdateRanges(){this.updateRanges.length=0}copy(e){return this.name=e.name,this.array=new e.array.constructor(e.array),this.itemSize=e.itemSize,this.count=e.count,this.normalized=e.normalized,this.usage=e.usage,this.gpuType=e.gpuType,this._normalizationScale=e._normalizationScale,this}copyAt(e,t,n){e*=this.itemSize,n*=t.itemSize;for(let s=0,r=this.itemSize;s<r;s++)this.array[e+s]=t.array[n+s];return this}copyArray(e){return this.array.set(e),this}applyMatrix3(e){if(this.itemSize===2)for(let t=0,n=this.count;t<n;t++)rl.fromBufferAttribute(this,t),rl.applyMatrix3(e),this.setXY(t,rl.x,rl.y);else if(this.itemSize===3)for(let t=0,n=this.count;t<n;t++)vn.fromBufferAttribute(this,t),vn.applyMatrix3(e),this.setXYZ(t,vn.x,vn.y,vn.z);return this}applyMatrix4(e){for(let t=0,n=this.count;t<n;t++)vn.fromBufferAttribute(this,t),vn.applyMatrix4(e),this.setXYZ(t,vn.x,vn.y,vn.z);return this}applyNormalMatrix(e){for(let t=0,n=this.count;t<n;t++)vn.fromBufferAttribute(this,t),vn.applyNormalMatrix(e),this.setXYZ(t,vn.x,vn.y,vn.z);return this}transformDirection(e){for(let t=0,n=this.count;t<n;t++)vn.fromBufferAttribute(this,t),vn.transformDirection(e),this.setXYZ(t,vn.x,vn.y,vn.z);return this}set(e,t=0){return this.array.set(e,t),this}getComponent(e,t){let n=this.array[e*this.itemSize+t];return this.normalized&&(n=this._denormalize(n)),n}setComponent(e,t,n){return this.normalized&&(n=this._normalize(n)),this.array[e*this.itemSize+t]=n,this}getX(e){let t=this.array[e*this.itemSize];return this.normalized&&(t=this._denormalize(t)),t}setX(e,t){return this.normalized&&(t=this._normalize(t)),this.array[e*this.itemSize]=t,this}getY(e){let t=this.array[e*this.itemSize+1];return this.normalized&&(t=this._denormalize(t)),t}setY(e,t){return this.normalized&&(t=this._normalize(t)),this.array[e*this.itemSize+1]=t,this}getZ(e){let t=this.array[e*this.itemSize+2];return this.normalized&&(t=this._denormalize(t)),t}setZ(e,t){return this.normalized&&(t=this._normalize(t)),this.array[e*this.itemSize+2]=t,this}getW(e){let t=this.array[e*this.itemSize+3];return this.normalized&&(t=this._denormalize(t)),t}setW(e,t){return this.normalized&&(t=this._normalize(t)),this.array[e*this.itemSize+3]=t,this}setXY(e,t,n){return e*=this.itemSize,this.normalized&&(t=this._normalize(t),n=this._normalize(n)),this.array[e+0]=t,this.array[e+1]=n,this}setXYZ(e,t,n,s){return e*=this.itemSize,this.normalized&&(t=this._normalize(t),n=this._normalize(n),s=this._normalize(s)),this.array[e+0]=t,this.array[e+1]=n,this.array[e+2]=s,this}setXYZW(e,t,n,s,r){return e*=this.itemSize,this.normalized&&(t=this._normalize(t),n=this._normalize(n),s=this._normalize(s),r=this._normalize(r)),this.array[e+0]=t,this.array[e+1]=n,this.array[e+2]=s,this.array[e+3]=r,this}onUpload(e){return this.onUploadCallback=e,this}clone(){return new this.constructor(this.array,this.itemSize).copy(this)}toJSON(){let e={itemSize:this.itemSize,type:this.array.constructor.name,array:Array.from(this.array),normalized:this.normalized};return e.name=this.name,e.usage=this.usage,e.gpuType=this.gpuType,e}dispose(){this.dispatchEvent({type:"dispose"})}_denormalize(e){let t=this._normalizationScale;return t!==void 0?Math.max(e/t,-1):Nv(e,this.array)}_normalize(e){let t=this._normalizationScale;return t!==void 0?Math.round(e*t):Fv(e,this.array)}};var ra=class extends Nn{constructor(e,t,n){super(new Uint8Array(e),t,n)}};var oa=class extends Nn{constructor(e,t,n){super(new Uint16Array(e),t,n)}};var aa=class extends Nn{constructor(e,t,n){super(new Uint32Array(e),t,n)}};var lt=class extends Nn{constructor(e,t,n){super(new Float32Array(e),t,n)}},Yv=new Gn,Yo=new k,_u=new k,is=class{constructor(e=new k,t=-1){this.isSphere=!0,this.center=e,this.radius=t}set(e,t){return this.center.copy(e),this.radius=t,this}setFromPoints(e,t){let n=this.center;t!==void 0?n.copy(t):Yv.setFromPoints(e).getCenter(n);let s=0;for(let r=0,o=e.length;r<o;r++)s=Math.max(s,n.distanceToSquared(e[r]));return this.radius=Math.sqrt(s),this}copy(e){return this.center.copy(e.center),this.radius=e.radius,this}isEmpty(){return this.radius<0}makeEmpty(){return this.center.set(0,0,0),this.radius=-1,this}containsPoint(e){return e.distanceToSquared(this.center)<=this.radius*this.radius}distanceToPoint(e){return e.distanceTo(this.center)-this.radius}intersectsSphere(e){let t=this.radius+e.radius;return e.center.distanceToSquared(this.center)<=t*t}intersectsBox(e){return e.intersectsSphere(this)}intersectsPlane(e){return Math.abs(e.distanceToPoint(this.center))<=this.radius}clampPoint(e,t){let n=this.center.distanceToSquared(e);return t.copy(e),n>this.radius*this.radius&&(t.sub(this.center).normalize(),t.multiplyScalar(this.radius).add(this.center)),t}getBoundingBox(e){return this.isEmpty()?(e.makeEmpty(),e):(e.set(this.center,this.center),e.expandByScalar(this.radius),e)}applyMatrix4(e){return this.center.applyMatrix4(e),this.radius=this.radius*e.getMaxScaleOnAxis(),this}translate(e){return this.center.add(e),this}expandByPoint(e){if(this.isEmpty())return this.center.copy(e),this.radius=0,this;Yo.subVectors(e,this.center);let t=Yo.lengthSq();if(t>this.radius*this.radius){let n=Math.sqrt(t),s=(n-this.radius)*.5;this.center.addScaledVector(Yo,s/n),this.radius+=s}return this}union(e){return e.isEmpty()?this:this.isEmpty()?(this.copy(e),this):(this.center.equals(e.center)===!0?this.radius=Math.max(this.radius,e.radius):(_u.subVectors(e.center,this.center).setLength(e.radius),this.expandByPoint(Yo.copy(e.center).add(_u)),this.expandByPoint(Yo.copy(e.center).sub(_u))),this)}equals(e){return e.center.equals(this.center)&&e.radius===this.radius}clone(){return new this.constructor().copy(this)}toJSON(){return{radius:this.radius,center:this.center.toArray()}}fromJSON(e){return this.radius=e.radius,this.center.fromArray(e.center),this}},$v=0,Ri=new it,xu=new ei,eo=new k,di=new Gn,$o=new Gn,In=new k,zt=class i extends ns{constructor(){super(),this.isBufferGeometry=!0,Object.defineProperty(this,"id",{value:$v++}),this.uuid=Ta(),this.name="",this.type="BufferGeometry",this.index=null,this.indirect=null,this.indirectOffset=0,this.attributes={},this.morphAttributes={},this.morphTargetsRelative=!1,this.groups=[],this.boundingBox=null,this.boundingSphere=null,this.drawRange={start:0,count:1/0},this.userData={},this._transformed=!1}getIndex(){return this.index}setIndex(e){return Array.isArray(e)?this.index=new(Iv(e)?aa:oa)(e,1):this.index=e,this}setIndirect(e,t=0){return this.indirect=e,this.indirectOffset=t,this}getIndirect(){return this.indirect}getAttribute(e){return this.attributes[e]}setAttribute(e,t){return this.attributes[e]=t,this}deleteAttribute(e){return delete this.attributes[e],this}hasAttribute(e){return this.attributes[e]!==void 0}addGroup(e,t,n=0){this.groups.push({start:e,count:t,materialIndex:n})}clearGroups(){this.groups=[]}setDrawRange(e,t){this.drawRange.start=e,this.drawRange.count=t}applyMatrix4(e){let t=this.attributes.position;t!==void 0&&(t.applyMatrix4(e),t.needsUpdate=!0);let n=this.attributes.normal;if(n!==void 0){let r=new qe().getNormalMatrix(e);n.applyNormalMatrix(r),n.needsUpdate=!0}let s=this.attributes.tangent;return s!==void 0&&(s.transformDirection(e),s.needsUpdate=!0),this.boundingBox!==null&&this.computeBoundingBox(),this.boundingSphere!==null&&this.computeBoundingSphere(),this._transformed=!0,this}applyQuaternion(e){return Ri.makeRotationFromQuaternion(e),this.applyMatrix4(Ri),this}rotateX(e){return Ri.makeRotationX(e),this.applyMatrix4(Ri),this}rotateY(e){return Ri.makeRotationY(e),this.applyMatrix4(Ri),this}rotateZ(e){return Ri.makeRotationZ(e),this.applyMatrix4(Ri),this}translate(e,t,n){return Ri.makeTranslation(e,t,n),this.applyMatrix4(Ri),this}scale(e,t,n){return Ri.makeScale(e,t,n),this.applyMatrix4(Ri),this}lookAt(e){return xu.lookAt(e),xu.updateMatrix(),this.applyMatrix4(xu.matrix),this}center(){return this.computeBoundingBox(),this.boundingBox.getCenter(eo).negate(),this.translate(eo.x,eo.y,eo.z),this}setFromPoints(e){let t=this.getAttribute("position");if(t===void 0){let n=[];for(let s=0,r=e.length;s<r;s++){let o=e[s];n.push(o.x,o.y,o.z||0)}this.setAttribute("position",new lt(n,3))}else{let n=Math.min(e.length,t.count);for(let s=0;s<n;s++){let r=e[s];t.setXYZ(s,r.x,r.y,r.z||0)}e.length>t.count&&$e("BufferGeometry: Buffer size too small for points data. Use .dispose() and create a new geometry."),t.needsUpdate=!0}return this}computeBoundingBox(){this.boundingBox===null&&(this.boundingBox=new Gn);let e=this.attributes.position,t=this.morphAttributes.position;if(e&&e.isGLBufferAttribute){Qe("BufferGeometry.computeBoundingBox(): GLBufferAttribute requires a manual bounding box.",this),this.boundingBox.set(new k(-1/0,-1/0,-1/0),new k(1/0,1/0,1/0));return}if(e!==void 0){if(this.boundingBox.setFromBufferAttribute(e),t)for(let n=0,s=t.length;n<s;n++){let r=t[n];di.setFromBufferAttribute(r),this.morphTargetsRelative?(In.addVectors(this.boundingBox.min,di.min),this.boundingBox.expandByPoint(In),In.addVectors(this.boundingBox.max,di.max),this.boundingBox.expandByPoint(In)):(this.boundingBox.expandByPoint(di.min),this.boundingBox.expandByPoint(di.max))}}else this.boundingBox.makeEmpty();(isNaN(this.boundingBox.min.x)||isNaN(this.boundingBox.min.y)||isNaN(this.boundingBox.min.z))&&Qe('BufferGeometry.computeBoundingBox(): Computed min/max have NaN values. The "position" attribute is likely to have NaN values.',this)}computeBoundingSphere(){this.boundingSphere===null&&(this.boundingSphere=new is);let e=this.attributes.position,t=this.morphAttributes.position;if(e&&e.isGLBufferAttribute){Qe("BufferGeometry.computeBoundingSphere(): GLBufferAttribute requires a manual bounding sphere.",this),this.boundingSphere.set(new k,1/0);return}if(e){let n=this.boundingSphere.center;if(di.setFromBufferAttribute(e),t)for(let r=0,o=t.length;r<o;r++){let a=t[r];$o.setFromBufferAttribute(a),this.morphTargetsRelative?(In.addVectors(di.min,$o.min),di.expandByPoint(In),In.addVectors(di.max,$o.max),di.expandByPoint(In)):(di.expandByPoint($o.min),di.expandByPoint($o.max))}di.getCenter(n);let s=0;for(let r=0,o=e.count;r<o;r++)In.fromBufferAttribute(e,r),s=Math.max(s,n.distanceToSquared(In));if(t)for(let r=0,o=t.length;r<o;r++){let a=t[r],l=this.morphTargetsRelative;for(let c=0,h=a.count;c<h;c++)In.fromBufferAttribute(a,c),l&&(eo.fromBufferAttribute(e,c),In.add(eo)),s=Math.max(s,n.distanceToSquared(In))}this.boundingSphere.radius=Math.sqrt(s),isNaN(this.boundingSphere.radius)&&Qe('BufferGeometry.computeBoundingSphere(): Computed radius is NaN. The "position" attribute is likely to have NaN values.',this)}}computeTangents(){let e=this.index,t=this.attributes;if(e===null||t.position===void 0||t.normal===void 0||t.uv===void 0){Qe("BufferGeometry: .computeTangents() failed. Missing required attributes (index, position, normal or uv)");return}let n=t.position,s=t.normal,r=t.uv,o=this.getAttribute("tangent");(o===void 0||o.count!==n.count)&&(o=new Nn(new Float32Array(4*n.count),4),this.setAttribute("tangent",o));let a=[],l=[],c=new Uint8Array(n.count);for(let O=0;O<n.count;O++)a[O]=new k,l[O]=new k;let h=new k,u=new k,d=new k,f=new vt,g=new vt,v=new vt,p=new k,m=new k;function y(O,I,L){c[O]=c[I]=c[L]=1,h.fromBufferAttribute(n,O),u.fromBufferAttribute(n,I),d.fromBufferAttribute(n,L),f.fromBufferAttribute(r,O),g.fromBufferAttribute(r,I),v.fromBufferAttribute(r,L),u.sub(h),d.sub(h),g.sub(f),v.sub(f);let H=1/(g.x*v.y-v.x*g.y);isFinite(H)&&(p.copy(u).multiplyScalar(v.y).addScaledVector(d,-g.y).multiplyScalar(H),m.copy(d).multiplyScalar(g.x).addScaledVector(u,-v.x).multiplyScalar(H),a[O].add(p),a[I].add(p),a[L].add(p),l[O].add(m),l[I].add(m),l[L].add(m))}let R=this.groups;R.length===0&&(R=[{start:0,count:e.count}]);for(let O=0,I=R.length;O<I;++O){let L=R[O],H=L.start,V=L.count;for(let N=H,X=H+V;N<X;N+=3)y(e.getX(N+0),e.getX(N+1),e.getX(N+2))}let b=new k,A=new k,E=new k,_=new k;function T(O){E.fromBufferAttribute(s,O),_.copy(E);let I=a[O];b.copy(I),b.sub(E.multiplyScalar(E.dot(I))).normalize(),A.crossVectors(_,I);let H=A.dot(l[O])<0?-1:1;o.setXYZW(O,b.x,b.y,b.z,H)}for(let O=0,I=n.count;O<I;++O)c[O]&&T(O);this._transformed=!0}computeVertexNormals(){let e=this.index,t=this.getAttribute("position");if(t!==void 0){let n=this.getAttribute("normal");if(n===void 0||n.count!==t.count)n=new Nn(new Float32Array(t.count*3),3),this.setAttribute("normal",n);else for(let d=0,f=n.count;d<f;d++)n.setXYZ(d,0,0,0);let s=new k,r=new k,o=new k,a=new k,l=new k,c=new k,h=new k,u=new k;if(e)for(let d=0,f=e.count;d<f;d+=3){let g=e.getX(d+0),v=e.getX(d+1),p=e.getX(d+2);s.fromBufferAttribute(t,g),r.fromBufferAttribute(t,v),o.fromBufferAttribute(t,p),h.subVectors(o,r),u.subVectors(s,r),h.cross(u),a.fromBufferAttribute(n,g),l.fromBufferAttribute(n,v),c.fromBufferAttribute(n,p),a.add(h),l.add(h),c.add(h),n.setXYZ(g,a.x,a.y,a.z),n.setXYZ(v,l.x,l.y,l.z),n.setXYZ(p,c.x,c.y,c.z)}else for(let d=0,f=t.count;d<f;d+=3)s.fromBufferAttribute(t,d+0),r.fromBufferAttribute(t,d+1),o.fromBufferAttribute(t,d+2),h.subVectors(o,r),u.subVectors(s,r),h.cross(u),n.setXYZ(d+0,h.x,h.y,h.z),n.setXYZ(d+1,h.x,h.y,h.z),n.setXYZ(d+2,h.x,h.y,h.z);this.normalizeNormals(),n.needsUpdate=!0}}normalizeNormals(){let e=this.attributes.normal;for(let t=0,n=e.count;t<n;t++)In.fromBufferAttribute(e,t),In.normalize(),e.setXYZ(t,In.x,In.y,In.z)}toNonIndexed(){function e(a,l){let c=a.array,h=a.itemSize,u=a.normalized,d=new c.constructor(l.length*h),f=0,g=0;for(let v=0,p=l.length;v<p;v++){a.isInterleavedBufferAttribute?f=l[v]*a.data.stride+a.offset:f=l[v]*h;for(let m=0;m<h;m++)d[g++]=c[f++]}return new Nn(d,h,u)}if(this.index===null)return $e("BufferGeometry.toNonIndexed(): BufferGeometry is already non-indexed."),this;let t=new i,n=this.index.array,s=this.attributes;for(let a in s){let l=s[a],c=e(l,n);t.setAttribute(a,c)}let r=this.morphAttributes;for(let a in r){let l=[],c=r[a];for(let h=0,u=c.length;h<u;h++){let d=c[h],f=e(d,n);l.push(f)}t.morphAttributes[a]=l}t.morphTargetsRelative=this.morphTargetsRelative;let o=this.groups;for(let a=0,l=o.length;a<l;a++){let c=o[a];t.addGroup(c.start,c.count,c.materialIndex)}return t}toJSON(){let e={metadata:{version:4.7,type:"BufferGeometry",generator:"BufferGeometry.toJSON"}};if(e.uuid=this.uuid,e.type=this.parameters!==void 0&&this._transformed===!0?"BufferGeometry":this.type,e.name=this.name,Object.keys(this.userData).length>0&&(e.userData=this.userData),this.parameters!==void 0&&this._transformed!==!0){let l=this.parameters;for(let c in l)l[c]!==void 0&&(e[c]=l[c]);return e}e.data={attributes:{}};let t=this.index;t!==null&&(e.data.index={type:t.array.constructor.name,array:Array.prototype.slice.call(t.array)});let n=this.attributes;for(let l in n){let c=n[l];e.data.attributes[l]=c.toJSON(e.data)}let s={},r=!1;for(let l in this.morphAttributes){let c=this.morphAttributes[l],h=[];for(let u=0,d=c.length;u<d;u++){let f=c[u];h.push(f.toJSON(e.data))}h.length>0&&(s[l]=h,r=!0)}r&&(e.data.morphAttributes=s,e.data.morphTargetsRelative=this.morphTargetsRelative);let o=this.groups;o.length>0&&(e.data.groups=JSON.parse(JSON.stringify(o)));let a=this.boundingSphere;return a!==null&&(e.data.boundingSphere=a.toJSON()),e}clone(){return new this.constructor().copy(this)}copy(e){this.index=null,this.attributes={},this.morphAttributes={},this.groups=[],this.boundingBox=null,this.boundingSphere=null;let t={};this.name=e.name;let n=e.index;n!==null&&this.setIndex(n.clone());let s=e.attributes;for(let c in s){let h=s[c];this.setAttribute(c,h.clone(t))}let r=e.morphAttributes;for(let c in r){let h=[],u=r[c];for(let d=0,f=u.length;d<f;d++)h.push(u[d].clone(t));this.morphAttributes[c]=h}this.morphTargetsRelative=e.morphTargetsRelative;let o=e.groups;for(let c=0,h=o.length;c<h;c++){let u=o[c];this.addGroup(u.start,u.count,u.materialIndex)}let a=e.boundingBox;a!==null&&(this.boundingBox=a.clone());let l=e.boundingSphere;return l!==null&&(this.boundingSphere=l.clone()),this.drawRange.start=e.drawRange.start,this.drawRange.count=e.drawRange.count,this.userData=e.userData,this._transformed=e._transformed,this}dispose(){this.dispatchEvent({type:"dispose"})}};var yu=new k,Zv=new k,Kv=new qe,zi=class{constructor(e=new k(1,0,0),t=0){this.isPlane=!0,this.normal=e,this.constant=t}set(e,t){return this.normal.copy(e),this.constant=t,this}setComponents(e,t,n,s){return this.normal.set(e,t,n),this.constant=s,this}setFromNormalAndCoplanarPoint(e,t){return this.normal.copy(e),this.constant=-t.dot(this.normal),this}setFromCoplanarPoints(e,t,n){let s=yu.subVectors(n,t).cross(Zv.subVectors(e,t)).normalize();return this.setFromNormalAndCoplanarPoint(s,e),this}copy(e){return this.normal.copy(e.normal),this.constant=e.constant,this}normalize(){let e=1/this.normal.length();return this.normal.multiplyScalar(e),this.constant*=e,this}negate(){return this.constant*=-1,this.normal.negate(),this}distanceToPoint(e){return this.normal.dot(e)+this.constant}distanceToSphere(e){return this.distanceToPoint(e.center)-e.radius}projectPoint(e,t){return t.copy(e).addScaledVector(this.normal,-this.distanceToPoint(e))}intersectLine(e,t,n=!0){let s=e.delta(yu),r=this.normal.dot(s);if(r===0)return this.distanceToPoint(e.start)===0?t.copy(e.start):null;let o=-(e.start.dot(this.normal)+this.constant)/r;return n===!0&&(o<0||o>1)?null:t.copy(e.start).addScaledVector(s,o)}intersectsLine(e){let t=this.distanceToPoint(e.start),n=this.distanceToPoint(e.end);return t<0&&n>0||n<0&&t>0}intersectsBox(e){return e.intersectsPlane(this)}intersectsSphere(e){return e.intersectsPlane(this)}coplanarPoint(e){return e.copy(this.normal).multiplyScalar(-this.constant)}applyMatrix4(e,t){let n=t||Kv.getNormalMatrix(e),s=this.coplanarPoint(yu).applyMatrix4(e),r=this.normal.applyMatrix3(n).normalize();return this.constant=-s.dot(r),this}translate(e){return this.constant-=e.dot(this.normal),this}equals(e){return e.normal.equals(this.normal)&&e.constant===this.constant}clone(){return new this.constructor().copy(this)}toJSON(){return{normal:this.normal.toArray(),constant:this.constant}}fromJSON(e){return this.normal.fromArray(e.normal),this.constant=e.constant,this}},Jv=0,Ms=class extends ns{constructor(){super(),this.isMaterial=!0,Object.defineProperty(this,"id",{value:Jv++}),this.uuid=Ta(),this.name="",this.type="Material",this.blending=ir,this.side=ss,this.vertexColors=!1,this.opacity=1,this.transparent=!1,this.alphaHash=!1,this.blendSrc=Nu,this.blendDst=Fu,this.blendEquation=Sr,this.blendSrcAlpha=null,this.blendDstAlpha=null,this.blendEquationAlpha=null,this.blendColor=new xt(0,0,0),this.blendAlpha=0,this.depthFunc=oo,this.depthTest=!0,this.depthWrite=!0,this.stencilWriteMask=255,this.stencilFunc=qp,this.stencilRef=0,this.stencilFuncMask=255,this.stencilFail=El,this.stencilZFail=El,this.stencilZPass=El,this.stencilWrite=!1,this.clippingPlanes=null,this.clipIntersection=!1,this.clipShadows=!1,this.shadowSide=null,this.colorWrite=!0,this.precision=null,this.polygonOffset=!1,this.polygonOffsetFactor=0,this.polygonOffsetUnits=0,this.dithering=!1,this.alphaToCoverage=!1,this.premultipliedAlpha=!1,this.forceSinglePass=!1,this.allowOverride=!0,this.visible=!0,this.toneMapped=!0,this.userData={},this.version=0,this._alphaTest=0}get alphaTest(){return this._alphaTest}set alphaTest(e){this._alphaTest>0!=e>0&&this.version++,this._alphaTest=e}onBeforeRender(){}onBeforeCompile(){}customProgramCacheKey(){return this.onBeforeCompile.toString()}setValues(e){if(e!==void 0)for(let t in e){let n=e[t];if(n===void 0){$e(`Material: parameter '${t}' has value of undefined.`);continue}let s=this[t];if(s===void 0){$e(`Material: '${t}' is not a property of THREE.${this.type}.`);continue}s&&s.isColor?s.set(n):s&&s.isVector2&&n&&n.isVector2||s&&s.isEuler&&n&&n.isEuler||s&&s.isVector3&&n&&n.isVector3?s.copy(n):this[t]=n}}toJSON(e){let t=e===void 0||typeof e=="string";t&&(e={textures:{},images:{}});let n={metadata:{version:4.7,type:"Material",generator:"Material.toJSON"}};n.uuid=this.uuid,n.type=this.type,n.blending=this.blending,n.side=this.side,n.shadowSide=this.shadowSide,n.vertexColors=this.vertexColors,n.opacity=this.opacity,n.transparent=this.transparent,n.blendSrc=this.blendSrc,n.blendDst=this.blendDst,n.blendEquation=this.blendEquation,n.blendSrcAlpha=this.blendSrcAlpha,n.blendDstAlpha=this.blendDstAlpha,n.blendEquationAlpha=this.blendEquationAlpha,n.blendColor=this.blendColor.getHex(),n.blendAlpha=this.blendAlpha,n.depthFunc=this.depthFunc,n.depthTest=this.depthTest,n.depthWrite=this.depthWrite,n.colorWrite=this.colorWrite,n.clipIntersection=this.clipIntersection,n.clipShadows=this.clipShadows,n.stencilWriteMask=this.stencilWriteMask,n.stencilFunc=this.stencilFunc,n.stencilRef=this.stencilRef,n.stencilFuncMask=this.stencilFuncMask,n.stencilFail=this.stencilFail,n.stencilZFail=this.stencilZFail,n.stencilZPass=this.stencilZPass,n.stencilWrite=this.stencilWrite,n.polygonOffset=this.polygonOffset,n.polygonOffsetFactor=this.polygonOffsetFactor,n.polygonOffsetUnits=this.polygonOffsetUnits,n.dithering=this.dithering,n.alphaTest=this.alphaTest,n.alphaHash=this.alphaHash,n.alphaToCoverage=this.alphaToCoverage,n.premultipliedAlpha=this.premultipliedAlpha,n.forceSinglePass=this.forceSinglePass,n.allowOverride=this.allowOverride,n.visible=this.visible,n.toneMapped=this.toneMapped,n.name=this.name,this.color&&this.color.isColor&&(n.color=this.color.getHex()),this.roughness!==void 0&&(n.roughness=this.roughness),this.metalness!==void 0&&(n.metalness=this.metalness),this.sheen!==void 0&&(n.sheen=this.sheen),this.sheenColor&&this.sheenColor.isColor&&(n.sheenColor=this.sheenColor.getHex()),this.sheenRoughness!==void 0&&(n.sheenRoughness=this.sheenRoughness),this.emissive&&this.emissive.isColor&&(n.emissive=this.emissive.getHex()),this.emissiveIntensity!==void 0&&(n.emissiveIntensity=this.emissiveIntensity),this.specular&&this.specular.isColor&&(n.specular=this.specular.getHex()),this.specularIntensity!==void 0&&(n.specularIntensity=this.specularIntensity),this.specularColor&&this.specularColor.isColor&&(n.specularColor=this.specularColor.getHex()),this.shininess!==void 0&&(n.shininess=this.shininess),this.clearcoat!==void 0&&(n.clearcoat=this.clearcoat),this.clearcoatRoughness!==void 0&&(n.clearcoatRoughness=this.clearcoatRoughness),this.diffuseRoughness!==void 0&&(n.diffuseRoughness=this.diffuseRoughness),this.diffuseRoughnessMap&&this.diffuseRoughnessMap.isTexture&&(n.diffuseRoughnessMap=this.diffuseRoughnessMap.toJSON(e).uuid),this.clearcoatMap&&this.clearcoatMap.isTexture&&(n.clearcoatMap=this.clearcoatMap.toJSON(e).uuid),this.clearcoatRoughnessMap&&this.clearcoatRoughnessMap.isTexture&&(n.clearcoatRoughnessMap=this.clearcoatRoughnessMap.toJSON(e).uuid),this.clearcoatNormalMap&&this.clearcoatNormalMap.isTexture&&(n.clearcoatNormalMap=this.clearcoatNormalMap.toJSON(e).uuid,n.clearcoatNormalScale=this.clearcoatNormalScale.toArray()),this.sheenColorMap&&this.sheenColorMap.isTexture&&(n.sheenColorMap=this.sheenColorMap.toJSON(e).uuid),this.sheenRoughnessMap&&this.sheenRoughnessMap.isTexture&&(n.sheenRoughnessMap=this.sheenRoughnessMap.toJSON(e).uuid),this.dispersion!==void 0&&(n.dispersion=this.dispersion),this.retroreflectivity!==void 0&&(n.retroreflectivity=this.retroreflectivity),this.iridescence!==void 0&&(n.iridescence=this.iridescence),this.iridescenceIOR!==void 0&&(n.iridescenceIOR=this.iridescenceIOR),this.iridescenceThicknessMinimum!==void 0&&(n.iridescenceThicknessMinimum=this.iridescenceThicknessMinimum),this.iridescenceThicknessMaximum!==void 0&&(n.iridescenceThicknessMaximum=this.iridescenceThicknessMaximum),this.iridescenceMap&&this.iridescenceMap.isTexture&&(n.iridescenceMap=this.iridescenceMap.toJSON(e).uuid),this.iridescenceThicknessMap&&this.iridescenceThicknessMap.isTexture&&(n.iridescenceThicknessMap=this.iridescenceThicknessMap.toJSON(e).uuid),this.anisotropy!==void 0&&(n.anisotropy=this.anisotropy),this.anisotropyRotation!==void 0&&(n.anisotropyRotation=this.anisotropyRotation),this.anisotropyMap&&this.anisotropyMap.isTexture&&(n.anisotropyMap=this.anisotropyMap.toJSON(e).uuid),this.map&&this.map.isTexture&&(n.map=this.map.toJSON(e).uuid),this.matcap&&this.matcap.isTexture&&(n.matcap=this.matcap.toJSON(e).uuid),this.alphaMap&&this.alphaMap.isTexture&&(n.alphaMap=this.alphaMap.toJSON(e).uuid),this.lightMap&&this.lightMap.isTexture&&(n.lightMap=this.lightMap.toJSON(e).uuid,n.lightMapIntensity=this.lightMapIntensity),this.aoMap&&this.aoMap.isTexture&&(n.aoMap=this.aoMap.toJSON(e).uuid,n.aoMapIntensity=this.aoMapIntensity),this.bumpMap&&this.bumpMap.isTexture&&(n.bumpMap=this.bumpMap.toJSON(e).uuid,n.bumpScale=this.bumpScale),this.normalMap&&this.normalMap.isTexture&&(n.normalMap=this.normalMap.toJSON(e).uuid,n.normalMapType=this.normalMapType,n.normalScale=this.normalScale.toArray()),this.displacementMap&&this.displacementMap.isTexture&&(n.displacementMap=this.displacementMap.toJSON(e).uuid,n.displacementScale=this.displacementScale,n.displacementBias=this.displacementBias),this.roughnessMap&&this.roughnessMap.isTexture&&(n.roughnessMap=this.roughnessMap.toJSON(e).uuid),this.metalnessMap&&this.metalnessMap.isTexture&&(n.metalnessMap=this.metalnessMap.toJSON(e).uuid),this.emissiveMap&&this.emissiveMap.isTexture&&(n.emissiveMap=this.emissiveMap.toJSON(e).uuid),this.specularMap&&this.specularMap.isTexture&&(n.specularMap=this.specularMap.toJSON(e).uuid),this.specularIntensityMap&&this.specularIntensityMap.isTexture&&(n.specularIntensityMap=this.specularIntensityMap.toJSON(e).uuid),this.specularColorMap&&this.specularColorMap.isTexture&&(n.specularColorMap=this.specularColorMap.toJSON(e).uuid),this.envMap&&this.envMap.isTexture&&(n.envMap=this.envMap.toJSON(e).uuid,this.combine!==void 0&&(n.combine=this.combine)),this.envMapRotation!==void 0&&(n.envMapRotation=this.envMapRotation.toArray()),this.envMapIntensity!==void 0&&(n.envMapIntensity=this.envMapIntensity),this.reflectivity!==void 0&&(n.reflectivity=this.reflectivity),this.refractionRatio!==void 0&&(n.refractionRatio=this.refractionRatio),this.gradientMap&&this.gradientMap.isTexture&&(n.gradientMap=this.gradientMap.toJSON(e).uuid),this.transmission!==void 0&&(n.transmission=this.transmission),this.transmissionMap&&this.transmissionMap.isTexture&&(n.transmissionMap=this.transmissionMap.toJSON(e).uuid),this.thickness!==void 0&&(n.thickness=this.thickness),this.thicknessMap&&this.thicknessMap.isTexture&&(n.thicknessMap=this.thicknessMap.toJSON(e).uuid),this.attenuationDistance!==void 0&&(n.attenuationDistance=this.attenuationDistance),this.attenuationColor!==void 0&&(n.attenuationColor=this.attenuationColor.getHex()),this.size!==void 0&&(n.size=this.size),this.sizeAttenuation!==void 0&&(n.sizeAttenuation=this.sizeAttenuation),Array.isArray(this.clippingPlanes)&&this.clippingPlanes.length>0&&(n.clippingPlanes=this.clippingPlanes.map(r=>r.toJSON())),this.rotation!==void 0&&(n.rotation=this.rotation),this.depthPacking!==void 0&&(n.depthPacking=this.depthPacking),this.linewidth!==void 0&&(n.linewidth=this.linewidth),this.linecap!==void 0&&(n.linecap=this.linecap),this.linejoin!==void 0&&(n.linejoin=this.linejoin),this.dashSize!==void 0&&(n.dashSize=this.dashSize),this.gapSize!==void 0&&(n.gapSize=this.gapSize),this.scale!==void 0&&(n.scale=this.scale),this.wireframe!==void 0&&(n.wireframe=this.wireframe),this.wireframeLinewidth!==void 0&&(n.wireframeLinewidth=this.wireframeLinewidth),this.wireframeLinecap!==void 0&&(n.wireframeLinecap=this.wireframeLinecap),this.wireframeLinejoin!==void 0&&(n.wireframeLinejoin=this.wireframeLinejoin),this.flatShading!==void 0&&(n.flatShading=this.flatShading),this.fog!==void 0&&(n.fog=this.fog),Object.keys(this.userData).length>0&&(n.userData=this.userData);function s(r){let o=[];for(let a in r){let l=r[a];delete l.metadata,o.push(l)}return o}if(t){let r=s(e.textures),o=s(e.images);r.length>0&&(n.textures=r),o.length>0&&(n.images=o)}return n}fromJSON(e,t){if(e.uuid!==void 0&&(this.uuid=e.uuid),e.name!==void 0&&(this.name=e.name),e.color!==void 0&&this.color!==void 0&&this.color.setHex(e.color),e.roughness!==void 0&&(this.roughness=e.roughness),e.metalness!==void 0&&(this.metalness=e.metalness),e.sheen!==void 0&&(this.sheen=e.sheen),e.sheenColor!==void 0&&(this.sheenColor=new xt().setHex(e.sheenColor)),e.sheenRoughness!==void 0&&(this.sheenRoughness=e.sheenRoughness),e.emissive!==void 0&&this.emissive!==void 0&&this.emissive.setHex(e.emissive),e.specular!==void 0&&this.specular!==void 0&&this.specular.setHex(e.specular),e.specularIntensity!==void 0&&(this.specularIntensity=e.specularIntensity),e.specularColor!==void 0&&this.specularColor!==void 0&&this.specularColor.setHex(e.specularColor),e.shininess!==void 0&&(this.shininess=e.shininess),e.clearcoat!==void 0&&(this.clearcoat=e.clearcoat),e.clearcoatRoughness!==void 0&&(this.clearcoatRoughness=e.clearcoatRoughness),e.diffuseRoughness!==void 0&&(this.diffuseRoughness=e.diffuseRoughness),e.dispersion!==void 0&&(this.dispersion=e.dispersion),e.retroreflectivity!==void 0&&(this.retroreflectivity=e.retroreflectivity),e.iridescence!==void 0&&(this.iridescence=e.iridescence),e.iridescenceIOR!==void 0&&(this.iridescenceIOR=e.iridescenceIOR),e.iridescenceThicknessMinimum!==void 0&&(this.iridescenceThicknessMinimum=e.iridescenceThicknessMinimum),e.iridescenceThicknessMaximum!==void 0&&(this.iridescenceThicknessMaximum=e.iridescenceThicknessMaximum),e.iridescenceThicknessRange!==void 0&&(this.iridescenceThicknessMinimum=e.iridescenceThicknessRange[0],this.iridescenceThicknessMaximum=e.iridescenceThicknessRange[1]),e.transmission!==void 0&&(this.transmission=e.transmission),e.thickness!==void 0&&(this.thickness=e.thickness),e.attenuationDistance!==void 0&&(this.attenuationDistance=e.attenuationDistance),e.attenuationColor!==void 0&&this.attenuationColor!==void 0&&this.attenuationColor.setHex(e.attenuationColor),e.anisotropy!==void 0&&(this.anisotropy=e.anisotropy),e.anisotropyRotation!==void 0&&(this.anisotropyRotation=e.anisotropyRotation),e.fog!==void 0&&(this.fog=e.fog),e.flatShading!==void 0&&(this.flatShading=e.flatShading),e.blending!==void 0&&(this.blending=e.blending),e.combine!==void 0&&(this.combine=e.combine),e.side!==void 0&&(this.side=e.side),e.shadowSide!==void 0&&(this.shadowSide=e.shadowSide),e.opacity!==void 0&&(this.opacity=e.opacity),e.transparent!==void 0&&(this.transparent=e.transparent),e.alphaTest!==void 0&&(this.alphaTest=e.alphaTest),e.alphaHash!==void 0&&(this.alphaHash=e.alphaHash),e.depthFunc!==void 0&&(this.depthFunc=e.depthFunc),e.depthTest!==void 0&&(this.depthTest=e.depthTest),e.depthWrite!==void 0&&(this.depthWrite=e.depthWrite),e.colorWrite!==void 0&&(this.colorWrite=e.colorWrite),e.clippingPlanes!==void 0&&(this.clippingPlanes=e.clippingPlanes.map(n=>new zi().fromJSON(n))),e.clipIntersection!==void 0&&(this.clipIntersection=e.clipIntersection),e.clipShadows!==void 0&&(this.clipShadows=e.clipShadows),e.depthPacking!==void 0&&(this.depthPacking=e.depthPacking),e.blendSrc!==void 0&&(this.blendSrc=e.blendSrc),e.blendDst!==void 0&&(this.blendDst=e.blendDst),e.blendEquation!==void 0&&(this.blendEquation=e.blendEquation),e.blendSrcAlpha!==void 0&&(this.blendSrcAlpha=e.blendSrcAlpha),e.blendDstAlpha!==void 0&&(this.blendDstAlpha=e.blendDstAlpha),e.blendEquationAlpha!==void 0&&(this.blendEquationAlpha=e.blendEquationAlpha),e.blendColor!==void 0&&this.blendColor!==void 0&&this.blendColor.setHex(e.blendColor),e.blendAlpha!==void 0&&(this.blendAlpha=e.blendAlpha),e.stencilWriteMask!==void 0&&(this.stencilWriteMask=e.stencilWriteMask),e.stencilFunc!==void 0&&(this.stencilFunc=e.stencilFunc),e.stencilRef!==void 0&&(this.stencilRef=e.stencilRef),e.stencilFuncMask!==void 0&&(this.stencilFuncMask=e.stencilFuncMask),e.stencilFail!==void 0&&(this.stencilFail=e.stencilFail),e.stencilZFail!==void 0&&(this.stencilZFail=e.stencilZFail),e.stencilZPass!==void 0&&(this.stencilZPass=e.stencilZPass),e.stencilWrite!==void 0&&(this.stencilWrite=e.stencilWrite),e.wireframe!==void 0&&(this.wireframe=e.wireframe),e.wireframeLinewidth!==void 0&&(this.wireframeLinewidth=e.wireframeLinewidth),e.wireframeLinecap!==void 0&&(this.wireframeLinecap=e.wireframeLinecap),e.wireframeLinejoin!==void 0&&(this.wireframeLinejoin=e.wireframeLinejoin),e.rotation!==void 0&&(this.rotation=e.rotation),e.linewidth!==void 0&&(this.linewidth=e.linewidth),e.linecap!==void 0&&(this.linecap=e.linecap),e.linejoin!==void 0&&(this.linejoin=e.linejoin),e.dashSize!==void 0&&(this.dashSize=e.dashSize),e.gapSize!==void 0&&(this.gapSize=e.gapSize),e.scale!==void 0&&(this.scale=e.scale),e.polygonOffset!==void 0&&(this.polygonOffset=e.polygonOffset),e.polygonOffsetFactor!==void 0&&(this.polygonOffsetFactor=e.polygonOffsetFactor),e.polygonOffsetUnits!==void 0&&(this.polygonOffsetUnits=e.polygonOffsetUnits),e.dithering!==void 0&&(this.dithering=e.dithering),e.alphaToCoverage!==void 0&&(this.alphaToCoverage=e.alphaToCoverage),e.premultipliedAlpha!==void 0&&(this.premultipliedAlpha=e.premultipliedAlpha),e.forceSinglePass!==void 0&&(this.forceSinglePass=e.forceSinglePass),e.allowOverride!==void 0&&(this.allowOverride=e.allowOverride),e.visible!==void 0&&(this.visible=e.visible),e.toneMapped!==void 0&&(this.toneMapped=e.toneMapped),e.userData!==void 0&&(this.userData=e.userData),e.vertexColors!==void 0&&(typeof e.vertexColors=="number"?this.vertexColors=e.vertexColors>0:this.vertexColors=e.vertexColors),e.size!==void 0&&(this.size=e.size),e.sizeAttenuation!==void 0&&(this.sizeAttenuation=e.sizeAttenuation),e.map!==void 0&&(this.map=t[e.map]||null),e.matcap!==void 0&&(this.matcap=t[e.matcap]||null),e.alphaMap!==void 0&&(this.alphaMap=t[e.alphaMap]||null),e.bumpMap!==void 0&&(this.bumpMap=t[e.bumpMap]||null),e.bumpScale!==void 0&&(this.bumpScale=e.bumpScale),e.normalMap!==void 0&&(this.normalMap=t[e.normalMap]||null),e.normalMapType!==void 0&&(this.normalMapType=e.normalMapType),e.normalScale!==void 0){let n=e.normalScale;Array.isArray(n)===!1&&(n=[n,n]),this.normalScale=new vt().fromArray(n)}return e.displacementMap!==void 0&&(this.displacementMap=t[e.displacementMap]||null),e.displacementScale!==void 0&&(this.displacementScale=e.displacementScale),e.displacementBias!==void 0&&(this.displacementBias=e.displacementBias),e.roughnessMap!==void 0&&(this.roughnessMap=t[e.roughnessMap]||null),e.metalnessMap!==void 0&&(this.metalnessMap=t[e.metalnessMap]||null),e.emissiveMap!==void 0&&(this.emissiveMap=t[e.emissiveMap]||null),e.emissiveIntensity!==void 0&&(this.emissiveIntensity=e.emissiveIntensity),e.specularMap!==void 0&&(this.specularMap=t[e.specularMap]||null),e.specularIntensityMap!==void 0&&(this.specularIntensityMap=t[e.specularIntensityMap]||null),e.specularColorMap!==void 0&&(this.specularColorMap=t[e.specularColorMap]||null),e.envMap!==void 0&&(this.envMap=t[e.envMap]||null),e.envMapRotation!==void 0&&this.envMapRotation.fromArray(e.envMapRotation),e.envMapIntensity!==void 0&&(this.envMapIntensity=e.envMapIntensity),e.reflectivity!==void 0&&(this.reflectivity=e.reflectivity),e.refractionRatio!==void 0&&(this.refractionRatio=e.refractionRatio),e.lightMap!==void 0&&(this.lightMap=t[e.lightMap]||null),e.lightMapIntensity!==void 0&&(this.lightMapIntensity=e.lightMapIntensity),e.aoMap!==void 0&&(this.aoMap=t[e.aoMap]||null),e.aoMapIntensity!==void 0&&(this.aoMapIntensity=e.aoMapIntensity),e.gradientMap!==void 0&&(this.gradientMap=t[e.gradientMap]||null),e.clearcoatMap!==void 0&&(this.clearcoatMap=t[e.clearcoatMap]||null),e.clearcoatRoughnessMap!==void 0&&(this.clearcoatRoughnessMap=t[e.clearcoatRoughnessMap]||null),e.clearcoatNormalMap!==void 0&&(this.clearcoatNormalMap=t[e.clearcoatNormalMap]||null),e.clearcoatNormalScale!==void 0&&(this.clearcoatNormalScale=new vt().fromArray(e.clearcoatNormalScale)),e.diffuseRoughnessMap!==void 0&&(this.diffuseRoughnessMap=t[e.diffuseRoughnessMap]||null),e.iridescenceMap!==void 0&&(this.iridescenceMap=t[e.iridescenceMap]||null),e.iridescenceThicknessMap!==void 0&&(this.iridescenceThicknessMap=t[e.iridescenceThicknessMap]||null),e.transmissionMap!==void 0&&(this.transmissionMap=t[e.transmissionMap]||null),e.thicknessMap!==void 0&&(this.thicknessMap=t[e.thicknessMap]||null),e.anisotropyMap!==void 0&&(this.anisotropyMap=t[e.anisotropyMap]||null),e.sheenColorMap!==void 0&&(this.sheenColorMap=t[e.sheenColorMap]||null),e.sheenRoughnessMap!==void 0&&(this.sheenRoughnessMap=t[e.sheenRoughnessMap]||null),this}clone(){return new this.constructor().copy(this)}copy(e){this.name=e.name,this.blending=e.blending,this.side=e.side,this.vertexColors=e.vertexColors,this.opacity=e.opacity,this.transparent=e.transparent,this.blendSrc=e.blendSrc,this.blendDst=e.blendDst,this.blendEquation=e.blendEquation,this.blendSrcAlpha=e.blendSrcAlpha,this.blendDstAlpha=e.blendDstAlpha,this.blendEquationAlpha=e.blendEquationAlpha,this.blendColor.copy(e.blendColor),this.blendAlpha=e.blendAlpha,this.depthFunc=e.depthFunc,this.depthTest=e.depthTest,this.depthWrite=e.depthWrite,this.stencilWriteMask=e.stencilWriteMask,this.stencilFunc=e.stencilFunc,this.stencilRef=e.stencilRef,this.stencilFuncMask=e.stencilFuncMask,this.stencilFail=e.stencilFail,this.stencilZFail=e.stencilZFail,this.stencilZPass=e.stencilZPass,this.stencilWrite=e.stencilWrite;let t=e.clippingPlanes,n=null;if(t!==null){let s=t.length;n=new Array(s);for(let r=0;r!==s;++r)n[r]=t[r].clone()}return this.clippingPlanes=n,this.clipIntersection=e.clipIntersection,this.clipShadows=e.clipShadows,this.shadowSide=e.shadowSide,this.colorWrite=e.colorWrite,this.precision=e.precision,this.polygonOffset=e.polygonOffset,this.polygonOffsetFactor=e.polygonOffsetFactor,this.polygonOffsetUnits=e.polygonOffsetUnits,this.dithering=e.dithering,this.alphaTest=e.alphaTest,this.alphaHash=e.alphaHash,this.alphaToCoverage=e.alphaToCoverage,this.premultipliedAlpha=e.premultipliedAlpha,this.forceSinglePass=e.forceSinglePass,this.allowOverride=e.allowOverride,this.visible=e.visible,this.toneMapped=e.toneMapped,this.userData=JSON.parse(JSON.stringify(e.userData)),this}dispose(){this.dispatchEvent({type:"dispose"})}set needsUpdate(e){e===!0&&this.version++}};var ys=new k,bu=new k,ol=new k,al=new k,ho=class{constructor(e=new k,t=new k(0,0,-1)){this.origin=e,this.direction=t}set(e,t){return this.origin.copy(e),this.direction.copy(t),this}copy(e){return this.origin.copy(e.origin),this.direction.copy(e.direction),this}at(e,t){return t.copy(this.origin).addScaledVector(this.direction,e)}lookAt(e){return this.direction.copy(e).sub(this.origin).normalize(),this}recast(e){return this.origin.copy(this.at(e,ys)),this}closestPointToPoint(e,t){t.subVectors(e,this.origin);let n=t.dot(this.direction);return n<0?t.copy(this.origin):t.copy(this.origin).addScaledVector(this.direction,n)}distanceToPoint(e){return Math.sqrt(this.distanceSqToPoint(e))}distanceSqToPoint(e){let t=ys.subVectors(e,this.origin).dot(this.direction);return t<0?this.origin.distanceToSquared(e):(ys.copy(this.origin).addScaledVector(this.direction,t),ys.distanceToSquared(e))}distanceSqToSegment(e,t,n,s){bu.copy(e).add(t).multiplyScalar(.5),ol.copy(t).sub(e).normalize(),al.copy(this.origin).sub(bu);let r=e.distanceTo(t)*.5,o=-this.direction.dot(ol),a=al.dot(this.direction),l=-al.dot(ol),c=al.lengthSq(),h=Math.abs(1-o*o),u,d,f,g;if(h>0)if(u=o*l-a,d=o*a-l,g=r*h,u>=0)if(d>=-g)if(d<=g){let v=1/h;u*=v,d*=v,f=u*(u+o*d+2*a)+d*(o*u+d+2*l)+c}else d=r,u=Math.max(0,-(o*d+a)),f=-u*u+d*(d+2*l)+c;else d=-r,u=Math.max(0,-(o*d+a)),f=-u*u+d*(d+2*l)+c;else d<=-g?(u=Math.max(0,-(-o*r+a)),d=u>0?-r:Math.min(Math.max(-r,-l),r),f=-u*u+d*(d+2*l)+c):d<=g?(u=0,d=Math.min(Math.max(-r,-l),r),f=d*(d+2*l)+c):(u=Math.max(0,-(o*r+a)),d=u>0?r:Math.min(Math.max(-r,-l),r),f=-u*u+d*(d+2*l)+c);else d=o>0?-r:r,u=Math.max(0,-(o*d+a)),f=-u*u+d*(d+2*l)+c;return n&&n.copy(this.origin).addScaledVector(this.direction,u),s&&s.copy(bu).addScaledVector(ol,d),f}intersectSphere(e,t){if(e.radius<0)return null;ys.subVectors(e.center,this.origin);let n=ys.dot(this.direction),s=ys.dot(ys)-n*n,r=e.radius*e.radius;if(s>r)return null;let o=Math.sqrt(r-s),a=n-o,l=n+o;return l<0?null:a<0?this.at(l,t):this.at(a,t)}intersectsSphere(e){return e.radius<0?!1:this.distanceSqToPoint(e.center)<=e.radius*e.radius}distanceToPlane(e){let t=e.normal.dot(this.direction);if(t===0)return e.distanceToPoint(this.origin)===0?0:null;let n=-(this.origin.dot(e.normal)+e.constant)/t;return n>=0?n:null}intersectPlane(e,t){let n=this.distanceToPlane(e);return n===null?null:this.at(n,t)}intersectsPlane(e){let t=e.distanceToPoint(this.origin);return t===0||e.normal.dot(this.direction)*t<0}intersectBox(e,t){let n,s,r,o,a,l,c=1/this.direction.x,h=1/this.direction.y,u=1/this.direction.z,d=this.origin;return c>=0?(n=(e.min.x-d.x)*c,s=(e.max.x-d.x)*c):(n=(e.max.x-d.x)*c,s=(e.min.x-d.x)*c),h>=0?(r=(e.min.y-d.y)*h,o=(e.max.y-d.y)*h):(r=(e.max.y-d.y)*h,o=(e.min.y-d.y)*h),n>o||r>s||((r>n||isNaN(n))&&(n=r),(o<s||isNaN(s))&&(s=o),u>=0?(a=(e.min.z-d.z)*u,l=(e.max.z-d.z)*u):(a=(e.max.z-d.z)*u,l=(e.min.z-d.z)*u),n>l||a>s)||((a>n||n!==n)&&(n=a),(l<s||s!==s)&&(s=l),s<0)?null:this.at(n>=0?n:s,t)}intersectsBox(e){return this.intersectBox(e,ys)!==null}intersectTriangle(e,t,n,s,r){let o=this.origin,a=this.direction,l=a.x,c=a.y,h=a.z,u=e.x-o.x,d=e.y-o.y,f=e.z-o.z,g=t.x-o.x,v=t.y-o.y,p=t.z-o.z,m=n.x-o.x,y=n.y-o.y,R=n.z-o.z,b=Math.abs(l),A=Math.abs(c),E=Math.abs(h),_,T,O,I,L,H,V,N,X,$,W,ce;if(b>=A&&b>=E?(O=l,H=u,X=g,ce=m,l>=0?(_=c,T=h,I=d,L=f,V=v,N=p,$=y,W=R):(_=h,T=c,I=f,L=d,V=p,N=v,$=R,W=y)):A>=E?(O=c,H=d,X=v,ce=y,c>=0?(_=h,T=l,I=f,L=u,V=p,N=g,$=R,W=m):(_=l,T=h,I=u,L=f,V=g,N=p,$=m,W=R)):(O=h,H=f,X=p,ce=R,h>=0?(_=l,T=c,I=u,L=d,V=g,N=v,$=m,W=y):(_=c,T=l,I=d,L=u,V=v,N=g,$=y,W=m)),O===0)return null;let J=_/O,Q=T/O,se=1/O,de=I-J*H,ue=L-Q*H,ee=V-J*X,me=N-Q*X,_e=$-J*ce,Ae=W-Q*ce,Se=_e*me-Ae*ee,Ge=de*Ae-ue*_e,st=ee*ue-me*de;if(s){if(Se<0||Ge<0||st<0)return null}else if((Se<0||Ge<0||st<0)&&(Se>0||Ge>0||st>0))return null;let He=Se+Ge+st;if(He===0)return null;let ft=se*(Se*H+Ge*X+st*ce);return(He>0?ft<0:ft>0)?null:this.at(ft/He,r)}applyMatrix4(e){return this.origin.applyMatrix4(e),this.direction.transformDirection(e),this}equals(e){return e.origin.equals(this.origin)&&e.direction.equals(this.direction)}clone(){return new this.constructor().copy(this)}},uo=class extends Ms{constructor(e){super(),this.isMeshBasicMaterial=!0,this.type="MeshBasicMaterial",this.color=new xt(16777215),this.map=null,this.lightMap=null,this.lightMapIntensity=1,this.aoMap=null,this.aoMapIntensity=1,this.specularMap=null,this.alphaMap=null,this.envMap=null,this.envMapRotation=new Js,this.combine=Uu,this.reflectivity=1,this.refractionRatio=.98,this.wireframe=!1,this.wireframeLinewidth=1,this.wireframeLinecap="round",this.wireframeLinejoin="round",this.fog=!0,this.setValues(e)}copy(e){return super.copy(e),this.color.copy(e.color),this.map=e.map,this.lightMap=e.lightMap,this.lightMapIntensity=e.lightMapIntensity,this.aoMap=e.aoMap,this.aoMapIntensity=e.aoMapIntensity,this.specularMap=e.specularMap,this.alphaMap=e.alphaMap,this.envMap=e.envMap,this.envMapRotation.copy(e.envMapRotation),this.combine=e.combine,this.reflectivity=e.reflectivity,this.refractionRatio=e.refractionRatio,this.wireframe=e.wireframe,this.wireframeLinewidth=e.wireframeLinewidth,this.wireframeLinecap=e.wireframeLinecap,this.wireframeLinejoin=e.wireframeLinejoin,this.fog=e.fog,this}},ip=new it,fr=new ho,ll=new is,sp=new k,cl=new k,hl=new k,ul=new k,Su=new k,dl=new k,rp=new k,fl=new k,Bt=class extends ei{constructor(e=new zt,t=new uo){super(),this.isMesh=!0,this.type="Mesh",this.geometry=e,this.material=t,this.morphTargetDictionary=void 0,this.morphTargetInfluences=void 0,this.count=1,this.updateMorphTargets()}copy(e,t){return super.copy(e,t),e.morphTargetInfluences!==void 0?this.morphTargetInfluences=e.morphTargetInfluences.slice():this.morphTargetInfluences=void 0,e.morphTargetDictionary!==void 0?this.morphTargetDictionary=Object.assign({},e.morphTargetDictionary):this.morphTargetDictionary=void 0,this.material=Array.isArray(e.material)?e.material.slice():e.material,this.geometry=e.geometry,this}updateMorphTargets(){let t=this.geometry.morphAttributes,n=Object.keys(t);if(n.length>0){let s=t[n[0]];if(s!==void 0){this.morphTargetInfluences=[],this.morphTargetDictionary={};for(let r=0,o=s.length;r<o;r++){let a=s[r].name||String(r);this.morphTargetInfluences.push(0),this.morphTargetDictionary[a]=r}}}}getVertexPosition(e,t){let n=this.geometry,s=n.attributes.position,r=n.morphAttributes.position,o=n.morphTargetsRelative;t.fromBufferAttribute(s,e);let a=this.morphTargetInfluences;if(r&&a){dl.set(0,0,0);for(let l=0,c=r.length;l<c;l++){let h=a[l],u=r[l];h!==0&&(Su.fromBufferAttribute(u,e),o?dl.addScaledVector(Su,h):dl.addScaledVector(Su.sub(t),h))}t.add(dl)}return t}intersectsFrustum(e){return e.intersectsObject(this)}raycast(e,t){let n=this.geometry,s=this.material,r=this.matrixWorld;s!==void 0&&(n.boundingSphere===null&&n.computeBoundingSphere(),ll.copy(n.boundingSphere),ll.applyMatrix4(r),fr.copy(e.ray).recast(e.near),!(ll.containsPoint(fr.origin)===!1&&(fr.intersectSphere(ll,sp)===null||fr.origin.distanceToSquared(sp)>(e.far-e.near)**2))&&(ip.copy(r).invert(),fr.copy(e.ray).applyMatrix4(ip),!(n.boundingBox!==null&&fr.intersectsBox(n.boundingBox)===!1)&&this._computeIntersections(e,t,fr)))}_computeIntersections(e,t,n){let s,r=this.geometry,o=this.material,a=r.index,l=r.attributes.position,c=r.attributes.uv,h=r.attributes.uv1,u=r.attributes.normal,d=r.groups,f=r.drawRange;if(a!==null)if(Array.isArray(o))for(let g=0,v=d.length;g<v;g++){let p=d[g],m=o[p.materialIndex],y=Math.max(p.start,f.start),R=Math.min(a.count,Math.min(p.start+p.count,f.start+f.count));for(let b=y,A=R;b<A;b+=3){let E=a.getX(b),_=a.getX(b+1),T=a.getX(b+2);s=pl(this,m,e,n,c,h,u,E,_,T),s&&(s.faceIndex=Math.floor(b/3),s.face.materialIndex=p.materialIndex,t.push(s))}}else{let g=Math.max(0,f.start),v=Math.min(a.count,f.start+f.count);for(let p=g,m=v;p<m;p+=3){let y=a.getX(p),R=a.getX(p+1),b=a.getX(p+2);s=pl(this,o,e,n,c,h,u,y,R,b),s&&(s.faceIndex=Math.floor(p/3),t.push(s))}}else if(l!==void 0)if(Array.isArray(o))for(let g=0,v=d.length;g<v;g++){let p=d[g],m=o[p.materialIndex],y=Math.max(p.start,f.start),R=Math.min(l.count,Math.min(p.start+p.count,f.start+f.count));for(let b=y,A=R;b<A;b+=3){let E=b,_=b+1,T=b+2;s=pl(this,m,e,n,c,h,u,E,_,T),s&&(s.faceIndex=Math.floor(b/3),s.face.materialIndex=p.materialIndex,t.push(s))}}else{let g=Math.max(0,f.start),v=Math.min(l.count,f.start+f.count);for(let p=g,m=v;p<m;p+=3){let y=p,R=p+1,b=p+2;s=pl(this,o,e,n,c,h,u,y,R,b),s&&(s.faceIndex=Math.floor(p/3),t.push(s))}}}};function jv(i,e,t,n,s,r,o,a){let l;if(e.side===Jn?l=n.intersectTriangle(o,r,s,!0,a):l=n.intersectTriangle(s,r,o,e.side===ss,a),l===null)return null;fl.copy(a),fl.applyMatrix4(i.matrixWorld);let c=t.ray.origin.distanceTo(fl);return c<t.near||c>t.far?null:{distance:c,point:fl.clone(),object:i}}function pl(i,e,t,n,s,r,o,a,l,c){i.getVertexPosition(a,cl),i.getVertexPosition(l,hl),i.getVertexPosition(c,ul);let h=jv(i,e,t,n,cl,hl,ul,rp);if(h){let u=new k;Zs.getBarycoord(rp,cl,hl,ul,u),s&&(h.uv=Zs.getInterpolatedAttribute(s,a,l,c,u,new vt)),r&&(h.uv1=Zs.getInterpolatedAttribute(r,a,l,c,u,new vt)),o&&(h.normal=Zs.getInterpolatedAttribute(o,a,l,c,u,new k),h.normal.dot(n.direction)>0&&h.normal.multiplyScalar(-1));let d={a,b:l,c,normal:new k,materialIndex:0};Zs.getNormal(cl,hl,ul,d.normal),h.face=d,h.barycoord=u}return h}var mi=class extends Un{constructor(e=null,t=1,n=1,s,r,o,a,l,c=an,h=an,u,d){super(null,o,a,l,c,h,s,r,u,d),this.isDataTexture=!0,this.image={data:e,width:t,height:n},this.generateMipmaps=!1,this.flipY=!1,this.unpackAlignment=1}};var Pi=class extends Nn{constructor(e,t,n,s=1){super(e,t,n),this.isInstancedBufferAttribute=!0,this.meshPerAttribute=s}copy(e){return super.copy(e),this.meshPerAttribute=e.meshPerAttribute,this}toJSON(){let e=super.toJSON();return e.meshPerAttribute=this.meshPerAttribute,e.isInstancedBufferAttribute=!0,e}},to=new it,op=new it,ml=[],ap=new Gn,Qv=new it,Zo=new Bt,Ko=new is,js=class extends Bt{constructor(e,t,n){super(e,t),this.isInstancedMesh=!0,this.instanceMatrix=new Pi(new Float32Array(n*16),16),this.instanceColor=null,this.morphTexture=null,this.count=n,this.boundingBox=null,this.boundingSphere=null;for(let s=0;s<n;s++)this.setMatrixAt(s,Qv)}computeBoundingBox(){let e=this.geometry,t=this.count;this.boundingBox===null&&(this.boundingBox=new Gn),e.boundingBox===null&&e.computeBoundingBox(),this.boundingBox.makeEmpty();for(let n=0;n<t;n++)this.getMatrixAt(n,to),ap.copy(e.boundingBox).applyMatrix4(to),this.boundingBox.union(ap)}computeBoundingSphere(){let e=this.geometry,t=this.count;this.boundingSphere===null&&(this.boundingSphere=new is),e.boundingSphere===null&&e.computeBoundingSphere(),this.boundingSphere.makeEmpty();for(let n=0;n<t;n++)this.getMatrixAt(n,to),Ko.copy(e.boundingSphere).applyMatrix4(to),this.boundingSphere.union(Ko)}copy(e,t){return super.copy(e,t),this.instanceMatrix.copy(e.instanceMatrix),this.morphTexture=e.morphTexture!==null?e.morphTexture.clone():null,this.instanceColor=e.instanceColor!==null?e.instanceColor.clone():null,this.count=e.count,this.boundingBox=e.boundingBox!==null?e.boundingBox.clone():null,this.boundingSphere=e.boundingSphere!==null?e.boundingSphere.clone():null,this}getColorAt(e,t){return this.instanceColor===null?t.setRGB(1,1,1):t.fromArray(this.instanceColor.array,e*3)}getMatrixAt(e,t){return t.fromArray(this.instanceMatrix.array,e*16)}getMorphAt(e,t){let n=t.morphTargetInfluences,s=this.morphTexture.source.data.data,r=n.length+1,o=e*r+1;for(let a=0;a<n.length;a++)n[a]=s[o+a]}raycast(e,t){let n=this.matrixWorld,s=this.count;if(Zo.geometry=this.geometry,Zo.material=this.material,Zo.material!==void 0&&(this.boundingSphere===null&&this.computeBoundingSphere(),Ko.copy(this.boundingSphere),Ko.applyMatrix4(n),e.ray.intersectsSphere(Ko)!==!1))for(let r=0;r<s;r++){this.getMatrixAt(r,to),op.multiplyMatrices(n,to),Zo.matrixWorld=op,Zo.raycast(e,ml);for(let o=0,a=ml.length;o<a;o++){let l=ml[o];l.instanceId=r,l.object=this,t.push(l)}ml.length=0}}setColorAt(e,t){return this.instanceColor===null&&(this.instanceColor=new Pi(new Float32Array(this.instanceMatrix.count*3).fill(1),3)),t.toArray(this.instanceColor.array,e*3),this}setMatrixAt(e,t){return t.toArray(this.instanceMatrix.array,e*16),this}setMorphAt(e,t){let n=t.morphTargetInfluences,s=n.length+1;this.morphTexture===null&&(this.morphTexture=new mi(new Float32Array(s*this.count),s,this.count,hc,ti));let r=this.morphTexture.source.data.data,o=0;for(let c=0;c<n.length;c++)o+=n[c];let a=this.geometry.morphTargetsRelative?1:1-o,l=s*e;return r[l]=a,r.set(n,l+1),this}updateMorphTargets(){}dispose(){super.dispose(),this.instanceMatrix.dispose(),this.instanceColor!==null&&this.instanceColor.dispose(),this.morphTexture!==null&&(this.morphTexture.dispose(),this.morphTexture=null)}},pr=new is,e_=new vt(.5,.5),gl=new k,vr=class{constructor(e=new zi,t=new zi,n=new zi,s=new zi,r=new zi,o=new zi){this.planes=[e,t,n,s,r,o]}set(e,t,n,s,r,o){let a=this.planes;return a[0].copy(e),a[1].copy(t),a[2].copy(n),a[3].copy(s),a[4].copy(r),a[5].copy(o),this}copy(e){let t=this.planes;for(let n=0;n<6;n++)t[n].copy(e.planes[n]);return this}setFromProjectionMatrix(e,t=Ci,n=!1){let s=this.planes,r=e.elements,o=r[0],a=r[1],l=r[2],c=r[3],h=r[4],u=r[5],d=r[6],f=r[7],g=r[8],v=r[9],p=r[10],m=r[11],y=r[12],R=r[13],b=r[14],A=r[15];if(s[0].setComponents(c-o,f-h,m-g,A-y).normalize(),s[1].setComponents(c+o,f+h,m+g,A+y).normalize(),s[2].setComponents(c+a,f+u,m+v,A+R).normalize(),s[3].setComponents(c-a,f-u,m-v,A-R).normalize(),n)s[4].setComponents(l,d,p,b).normalize(),s[5].setComponents(c-l,f-d,m-p,A-b).normalize();else if(s[4].setComponents(c-l,f-d,m-p,A-b).normalize(),t===Ci)s[5].setComponents(c+l,f+d,m+p,A+b).normalize();else if(t===ta)s[5].setComponents(l,d,p,b).normalize();else throw new Error("THREE.Frustum.setFromProjectionMatrix(): Invalid coordinate system: "+t);return this}intersectsObject(e){if(e.boundingSphere!==void 0)e.boundingSphere===null&&e.computeBoundingSphere(),pr.copy(e.boundingSphere).applyMatrix4(e.matrixWorld);else{let t=e.geometry;t.boundingSphere===null&&t.computeBoundingSphere(),pr.copy(t.boundingSphere).applyMatrix4(e.matrixWorld)}return this.intersectsSphere(pr)}intersectsSprite(e){pr.center.set(0,0,0);let t=e_.distanceTo(e.center);return pr.radius=.7071067811865476+t,pr.applyMatrix4(e.matrixWorld),this.intersectsSphere(pr)}intersectsSphere(e){let t=this.planes,n=e.center,s=-e.radius;for(let r=0;r<6;r++)if(t[r].distanceToPoint(n)<s)return!1;return!0}intersectsBox(e){let t=this.planes;for(let n=0;n<6;n++){let s=t[n];if(gl.x=s.normal.x>0?e.max.x:e.min.x,gl.y=s.normal.y>0?e.max.y:e.min.y,gl.z=s.normal.z>0?e.max.z:e.min.z,s.distanceToPoint(gl)<0)return!1}return!0}containsPoint(e){let t=this.planes;for(let n=0;n<6;n++)if(t[n].distanceToPoint(e)<0)return!1;return!0}clone(){return new this.constructor().copy(this)}},lp=new it,kl=class i{constructor(){this.coordinateSystem=Ci,this._frustums=[],this._count=0}setFromArrayCamera(e){let t=e.cameras,n=this._frustums;for(let s=0;s<t.length;s++){let r=t[s];lp.multiplyMatrices(r.projectionMatrix,r.matrixWorldInverse),n[s]===void 0&&(n[s]=new vr),n[s].setFromProjectionMatrix(lp,r.coordinateSystem,r.reversedDepth)}return this._count=t.length,this}getFrustum(e){return this._frustums[e]}intersectsObject(e){let t=this._frustums;for(let n=0;n<this._count;n++)if(t[n].intersectsObject(e))return!0;return!1}intersectsSprite(e){let t=this._frustums;for(let n=0;n<this._count;n++)if(t[n].intersectsSprite(e))return!0;return!1}intersectsSphere(e){let t=this._frustums;for(let n=0;n<this._count;n++)if(t[n].intersectsSphere(e))return!0;return!1}intersectsBox(e){let t=this._frustums;for(let n=0;n<this._count;n++)if(t[n].intersectsBox(e))return!0;return!1}containsPoint(e){let t=this._frustums;for(let n=0;n<this._count;n++)if(t[n].containsPoint(e))return!0;return!1}copy(e){this.coordinateSystem=e.coordinateSystem;let t=this._frustums,n=e._frustums;for(let s=0;s<e._count;s++)t[s]===void 0&&(t[s]=new vr),t[s].copy(n[s]);return this._count=e._count,this}clone(){return new i().copy(this)}};var fo=class extends Ms{constructor(e){super(),this.isLineBasicMaterial=!0,this.type="LineBasicMaterial",this.color=new xt(16777215),this.map=null,this.linewidth=1,this.linecap="round",this.linejoin="round",this.fog=!0,this.setValues(e)}copy(e){return super.copy(e),this.color.copy(e.color),this.map=e.map,this.linewidth=e.linewidth,this.linecap=e.linecap,this.linejoin=e.linejoin,this.fog=e.fog,this}},zl=new k,Hl=new k,cp=new it,Jo=new ho,vl=new is,Mu=new k,hp=new k,Vl=class extends ei{constructor(e=new zt,t=new fo){super(),this.isLine=!0,this.type="Line",this.geometry=e,this.material=t,this.morphTargetDictionary=void 0,this.morphTargetInfluences=void 0,this.updateMorphTargets()}copy(e,t){return super.copy(e,t),e.morphTargetInfluences!==void 0?this.morphTargetInfluences=e.morphTargetInfluences.slice():this.morphTargetInfluences=void 0,e.morphTargetDictionary!==void 0?this.morphTargetDictionary=Object.assign({},e.morphTargetDictionary):this.morphTargetDictionary=void 0,this.material=Array.isArray(e.material)?e.material.slice():e.material,this.geometry=e.geometry,this}computeLineDistances(){let e=this.geometry;if(e.index===null){let t=e.attributes.position,n=[0];for(let s=1,r=t.count;s<r;s++)zl.fromBufferAttribute(t,s-1),Hl.fromBufferAttribute(t,s),n[s]=n[s-1],n[s]+=zl.distanceTo(Hl);e.setAttribute("lineDistance",new lt(n,1))}else $e("Line.computeLineDistances(): Computation only possible with non-indexed BufferGeometry.");return this}intersectsFrustum(e){return e.intersectsObject(this)}raycast(e,t){let n=this.geometry,s=this.matrixWorld,r=e.params.Line.threshold,o=n.drawRange;if(n.boundingSphere===null&&n.computeBoundingSphere(),vl.copy(n.boundingSphere),vl.applyMatrix4(s),vl.radius+=r,e.ray.intersectsSphere(vl)===!1)return;cp.copy(s).invert(),Jo.copy(e.ray).applyMatrix4(cp);let a=r/((this.scale.x+this.scale.y+this.scale.z)/3),l=a*a,c=this.isLineSegments?2:1,h=n.index,d=n.attributes.position;if(h!==null){let f=Math.max(0,o.start),g=Math.min(h.count,o.start+o.count);for(let v=f,p=g-1;v<p;v+=c){let m=h.getX(v),y=h.getX(v+1),R=_l(this,e,Jo,l,m,y,v);R&&t.push(R)}if(this.isLineLoop){let v=h.getX(g-1),p=h.getX(f),m=_l(this,e,Jo,l,v,p,g-1);m&&t.push(m)}}else{let f=Math.max(0,o.start),g=Math.min(d.count,o.start+o.count);for(let v=f,p=g-1;v<p;v+=c){let m=_l(this,e,Jo,l,v,v+1,v);m&&t.push(m)}if(this.isLineLoop){let v=_l(this,e,Jo,l,g-1,f,g-1);v&&t.push(v)}}}updateMorphTargets(){let t=this.geometry.morphAttributes,n=Object.keys(t);if(n.length>0){let s=t[n[0]];if(s!==void 0){this.morphTargetInfluences=[],this.morphTargetDictionary={};for(let r=0,o=s.length;r<o;r++){let a=s[r].name||String(r);this.morphTargetInfluences.push(0),this.morphTargetDictionary[a]=r}}}}};function _l(i,e,t,n,s,r,o){let a=i.geometry.attributes.position;if(zl.fromBufferAttribute(a,s),Hl.fromBufferAttribute(a,r),t.distanceSqToSegment(zl,Hl,Mu,hp)>n)return;Mu.applyMatrix4(i.matrixWorld);let c=e.ray.origin.distanceTo(Mu);if(!(c<e.near||c>e.far))return{distance:c,point:hp.clone().applyMatrix4(i.matrixWorld),index:o,face:null,faceIndex:null,barycoord:null,object:i}}var up=new k,dp=new k,po=class extends Vl{constructor(e,t){super(e,t),this.isLineSegments=!0,this.type="LineSegments"}computeLineDistances(){let e=this.geometry;if(e.index===null){let t=e.attributes.position,n=[];for(let s=0,r=t.count;s<r;s+=2)up.fromBufferAttribute(t,s),dp.fromBufferAttribute(t,s+1),n[s]=s===0?0:n[s-1],n[s+1]=n[s]+up.distanceTo(dp);e.setAttribute("lineDistance",new lt(n,1))}else $e("LineSegments.computeLineDistances(): Computation only possible with non-indexed BufferGeometry.");return this}};var Gl=class extends Ms{constructor(e){super(),this.isPointsMaterial=!0,this.type="PointsMaterial",this.color=new xt(16777215),this.map=null,this.alphaMap=null,this.size=1,this.sizeAttenuation=!0,this.fog=!0,this.setValues(e)}copy(e){return super.copy(e),this.color.copy(e.color),this.map=e.map,this.alphaMap=e.alphaMap,this.size=e.size,this.sizeAttenuation=e.sizeAttenuation,this.fog=e.fog,this}},fp=new it,Ru=new ho,xl=new is,yl=new k,la=class extends ei{constructor(e=new zt,t=new Gl){super(),this.isPoints=!0,this.type="Points",this.geometry=e,this.material=t,this.morphTargetDictionary=void 0,this.morphTargetInfluences=void 0,this.updateMorphTargets()}copy(e,t){return super.copy(e,t),e.morphTargetInfluences!==void 0?this.morphTargetInfluences=e.morphTargetInfluences.slice():this.morphTargetInfluences=void 0,e.morphTargetDictionary!==void 0?this.morphTargetDictionary=Object.assign({},e.morphTargetDictionary):this.morphTargetDictionary=void 0,this.material=Array.isArray(e.material)?e.material.slice():e.material,this.geometry=e.geometry,this}intersectsFrustum(e){return e.intersectsObject(this)}raycast(e,t){let n=this.geometry,s=this.matrixWorld,r=e.params.Points.threshold,o=n.drawRange;if(n.boundingSphere===null&&n.computeBoundingSphere(),xl.copy(n.boundingSphere),xl.applyMatrix4(s),xl.radius+=r,e.ray.intersectsSphere(xl)===!1)return;fp.copy(s).invert(),Ru.copy(e.ray).applyMatrix4(fp);let a=r/((this.scale.x+this.scale.y+this.scale.z)/3),l=a*a,c=n.index,u=n.attributes.position;if(c!==null){let d=Math.max(0,o.start),f=Math.min(c.count,o.start+o.count);for(let g=d,v=f;g<v;g++){let p=c.getX(g);yl.fromBufferAttribute(u,p),pp(yl,p,l,s,e,t,this)}}else{let d=Math.max(0,o.start),f=Math.min(u.count,o.start+o.count);for(let g=d,v=f;g<v;g++)yl.fromBufferAttribute(u,g),pp(yl,g,l,s,e,t,this)}}updateMorphTargets(){let t=this.geometry.morphAttributes,n=Object.keys(t);if(n.length>0){let s=t[n[0]];if(s!==void 0){this.morphTargetInfluences=[],this.morphTargetDictionary={};for(let r=0,o=s.length;r<o;r++){let a=s[r].name||String(r);this.morphTargetInfluences.push(0),this.morphTargetDictionary[a]=r}}}}};function pp(i,e,t,n,s,r,o){let a=Ru.distanceSqToPoint(i);if(a<t){let l=new k;Ru.closestPointToPoint(i,l),l.applyMatrix4(n);let c=s.ray.origin.distanceTo(l);if(c<s.near||c>s.far)return;r.push({distance:c,distanceToRay:Math.sqrt(a),point:l,index:e,face:null,faceIndex:null,barycoord:null,object:o})}}var ca=class extends Un{constructor(e=[],t=Mr,n,s,r,o,a,l,c,h){super(e,t,n,s,r,o,a,l,c,h),this.isCubeTexture=!0,this.flipY=!1}get images(){return this.image}set images(e){this.image=e}},ha=class extends Un{constructor(e,t,n,s,r,o,a,l,c){super(e,t,n,s,r,o,a,l,c),this.isCanvasTexture=!0,this.needsUpdate=!0}};var Hi=class extends Un{constructor(e,t,n=xi,s,r,o,a=an,l=an,c,h=Ss,u=1){if(h!==Ss&&h!==As)throw new Error("THREE.DepthTexture: format must be either THREE.DepthFormat or THREE.DepthStencilFormat");let d={width:e,height:t,depth:u};super(d,s,r,o,a,l,h,n,c),this.isDepthTexture=!0,this.flipY=!1,this.generateMipmaps=!1,this.compareFunction=null}copy(e){return super.copy(e),this.source=new lo(Object.assign({},e.image)),this.compareFunction=e.compareFunction,this}toJSON(e){let t=super.toJSON(e);return t.compareFunction=this.compareFunction,t}},ua=class extends Hi{constructor(e,t=xi,n=Mr,s,r,o=an,a=an,l,c=Ss){let h={width:e,height:e,depth:1},u=[h,h,h,h,h,h];super(e,e,t,n,s,r,o,a,l,c),this.image=u,this.isCubeDepthTexture=!0,this.isCubeTexture=!0}get images(){return this.image}set images(e){this.image=e}},da=class extends Un{constructor(e=null){super(),this.sourceTexture=e,this.isExternalTexture=!0}copy(e){return super.copy(e),this.sourceTexture=e.sourceTexture,this}},ws=class i extends zt{constructor(e=1,t=1,n=1,s=1,r=1,o=1){super(),this.type="BoxGeometry",this.parameters={width:e,height:t,depth:n,widthSegments:s,heightSegments:r,depthSegments:o};let a=this;s=Math.floor(s),r=Math.floor(r),o=Math.floor(o);let l=[],c=[],h=[],u=[],d=0,f=0;g("z","y","x",-1,-1,n,t,e,o,r,0),g("z","y","x",1,-1,n,t,-e,o,r,1),g("x","z","y",1,1,e,n,t,s,o,2),g("x","z","y",1,-1,e,n,-t,s,o,3),g("x","y","z",1,-1,e,t,n,s,r,4),g("x","y","z",-1,-1,e,t,-n,s,r,5),this.setIndex(l),this.setAttribute("position",new lt(c,3)),this.setAttribute("normal",new lt(h,3)),this.setAttribute("uv",new lt(u,2));function g(v,p,m,y,R,b,A,E,_,T,O){let I=b/_,L=A/T,H=b/2,V=A/2,N=E/2,X=_+1,$=T+1,W=0,ce=0,J=new k;for(let Q=0;Q<$;Q++){let se=Q*L-V;for(let de=0;de<X;de++){let ue=de*I-H;J[v]=ue*y,J[p]=se*R,J[m]=N,c.push(J.x,J.y,J.z),J[v]=0,J[p]=0,J[m]=E>0?1:-1,h.push(J.x,J.y,J.z),u.push(de/_),u.push(1-Q/T),W+=1}}for(let Q=0;Q<T;Q++)for(let se=0;se<_;se++){let de=d+se+X*Q,ue=d+se+X*(Q+1),ee=d+(se+1)+X*(Q+1),me=d+(se+1)+X*Q;l.push(de,ue,me),l.push(ue,ee,me),ce+=6}a.addGroup(f,ce,O),f+=ce,d+=W}}copy(e){return super.copy(e),this.parameters=Object.assign({},e.parameters),this}static fromJSON(e){return new i(e.width,e.height,e.depth,e.widthSegments,e.heightSegments,e.depthSegments)}},fa=class i extends zt{constructor(e=1,t=1,n=4,s=8,r=1){super(),this.type="CapsuleGeometry",this.parameters={radius:e,height:t,capSegments:n,radialSegments:s,heightSegments:r},t=Math.max(0,t),n=Math.max(1,Math.floor(n)),s=Math.max(3,Math.floor(s)),r=Math.max(1,Math.floor(r));let o=[],a=[],l=[],c=[],h=t/2,u=Math.PI/2*e,d=t,f=2*u+d,g=n*2+r,v=s+1,p=new k,m=new k;for(let y=0;y<=g;y++){let R=0,b=0,A=0,E=0;if(y<=n){let O=y/n,I=O*Math.PI/2;b=-h-e*Math.cos(I),A=e*Math.sin(I),E=-e*Math.cos(I),R=O*u}else if(y<=n+r){let O=(y-n)/r;b=-h+O*t,A=e,E=0,R=u+O*d}else{let O=(y-n-r)/n,I=O*Math.PI/2;b=h+e*Math.sin(I),A=e*Math.cos(I),E=e*Math.sin(I),R=u+d+O*u}let _=Math.max(0,Math.min(1,R/f)),T=0;y===0?T=.5/s:y===g&&(T=-.5/s);for(let O=0;O<=s;O++){let I=O/s,L=I*Math.PI*2,H=Math.sin(L),V=Math.cos(L);m.x=-A*V,m.y=b,m.z=A*H,a.push(m.x,m.y,m.z),p.set(-A*V,E,A*H),p.normalize(),l.push(p.x,p.y,p.z),c.push(I+T,_)}if(y>0){let O=(y-1)*v;for(let I=0;I<s;I++){let L=O+I,H=O+I+1,V=y*v+I,N=y*v+I+1;o.push(L,H,V),o.push(H,N,V)}}}this.setIndex(o),this.setAttribute("position",new lt(a,3)),this.setAttribute("normal",new lt(l,3)),this.setAttribute("uv",new lt(c,2))}copy(e){return super.copy(e),this.parameters=Object.assign({},e.parameters),this}static fromJSON(e){return new i(e.radius,e.height,e.capSegments,e.radialSegments,e.heightSegments)}},_r=class i extends zt{constructor(e=1,t=32,n=0,s=Math.PI*2){super(),this.type="CircleGeometry",this.parameters={radius:e,segments:t,thetaStart:n,thetaLength:s},t=Math.max(3,t);let r=[],o=[],a=[],l=[],c=new k,h=new vt;o.push(0,0,0),a.push(0,0,1),l.push(.5,.5);for(let u=0,d=3;u<=t;u++,d+=3){let f=n+u/t*s;c.x=e*Math.cos(f),c.y=e*Math.sin(f),o.push(c.x,c.y,c.z),a.push(0,0,1),h.x=(o[d]/e+1)/2,h.y=(o[d+1]/e+1)/2,l.push(h.x,h.y)}for(let u=1;u<=t;u++)r.push(u,u+1,0);this.setIndex(r),this.setAttribute("position",new lt(o,3)),this.setAttribute("normal",new lt(a,3)),this.setAttribute("uv",new lt(l,2))}copy(e){return super.copy(e),this.parameters=Object.assign({},e.parameters),this}static fromJSON(e){return new i(e.radius,e.segments,e.thetaStart,e.thetaLength)}},Es=class i extends zt{constructor(e=1,t=1,n=1,s=32,r=1,o=!1,a=0,l=Math.PI*2){super(),this.type="CylinderGeometry",this.parameters={radiusTop:e,radiusBottom:t,height:n,radialSegments:s,heightSegments:r,openEnded:o,thetaStart:a,thetaLength:l};let c=this;s=Math.floor(s),r=Math.floor(r);let h=[],u=[],d=[],f=[],g=0,v=[],p=n/2,m=0;y(),o===!1&&(e>0&&R(!0),t>0&&R(!1)),this.setIndex(h),this.setAttribute("position",new lt(u,3)),this.setAttribute("normal",new lt(d,3)),this.setAttribute("uv",new lt(f,2));function y(){let b=new k,A=new k,E=0,_=(t-e)/n;for(let T=0;T<=r;T++){let O=[],I=T/r,L=I*(t-e)+e;for(let H=0;H<=s;H++){let V=H/s,N=V*l+a,X=Math.sin(N),$=Math.cos(N);A.x=L*X,A.y=-I*n+p,A.z=L*$,u.push(A.x,A.y,A.z),b.set(X,_,$).normalize(),d.push(b.x,b.y,b.z),f.push(V,1-I),O.push(g++)}v.push(O)}for(let T=0;T<s;T++)for(let O=0;O<r;O++){let I=v[O][T],L=v[O+1][T],H=v[O+1][T+1],V=v[O][T+1];(e>0||O!==0)&&(h.push(I,L,V),E+=3),(t>0||O!==r-1)&&(h.push(L,H,V),E+=3)}c.addGroup(m,E,0),m+=E}function R(b){let A=g,E=new vt,_=new k,T=0,O=b===!0?e:t,I=b===!0?1:-1;for(let H=1;H<=s;H++)u.push(0,p*I,0),d.push(0,I,0),f.push(.5,.5),g++;let L=g;for(let H=0;H<=s;H++){let N=H/s*l+a,X=Math.cos(N),$=Math.sin(N);_.x=O*$,_.y=p*I,_.z=O*X,u.push(_.x,_.y,_.z),d.push(0,I,0),E.x=X*.5+.5,E.y=$*.5*I+.5,f.push(E.x,E.y),g++}for(let H=0;H<s;H++){let V=A+H,N=L+H;b===!0?h.push(N,N+1,V):h.push(N+1,N,V),T+=3}c.addGroup(m,T,b===!0?1:2),m+=T}}copy(e){return super.copy(e),this.parameters=Object.assign({},e.parameters),this}static fromJSON(e){return new i(e.radiusTop,e.radiusBottom,e.height,e.radialSegments,e.heightSegments,e.openEnded,e.thetaStart,e.thetaLength)}},pa=class i extends Es{constructor(e=1,t=1,n=32,s=1,r=!1,o=0,a=Math.PI*2){super(0,e,t,n,s,r,o,a),this.type="ConeGeometry",this.parameters={radius:e,height:t,radialSegments:n,heightSegments:s,openEnded:r,thetaStart:o,thetaLength:a}}static fromJSON(e){return new i(e.radius,e.height,e.radialSegments,e.heightSegments,e.openEnded,e.thetaStart,e.thetaLength)}};var Qs=class i extends zt{constructor(e=1,t=1,n=1,s=1){super(),this.type="PlaneGeometry",this.parameters={width:e,height:t,widthSegments:n,heightSegments:s};let r=e/2,o=t/2,a=Math.floor(n),l=Math.floor(s),c=a+1,h=l+1,u=e/a,d=t/l,f=[],g=[],v=[],p=[];for(let m=0;m<h;m++){let y=m*d-o;for(let R=0;R<c;R++){let b=R*u-r;g.push(b,-y,0),v.push(0,0,1),p.push(R/a),p.push(1-m/l)}}for(let m=0;m<l;m++)for(let y=0;y<a;y++){let R=y+c*m,b=y+c*(m+1),A=y+1+c*(m+1),E=y+1+c*m;f.push(R,b,E),f.push(b,A,E)}this.setIndex(f),this.setAttribute("position",new lt(g,3)),this.setAttribute("normal",new lt(v,3)),this.setAttribute("uv",new lt(p,2))}copy(e){return super.copy(e),this.parameters=Object.assign({},e.parameters),this}static fromJSON(e){return new i(e.width,e.height,e.widthSegments,e.heightSegments)}};var Ts=class i extends zt{constructor(e=1,t=32,n=16,s=0,r=Math.PI*2,o=0,a=Math.PI){super(),this.type="SphereGeometry",this.parameters={radius:e,widthSegments:t,heightSegments:n,phiStart:s,phiLength:r,thetaStart:o,thetaLength:a},t=Math.max(3,Math.floor(t)),n=Math.max(2,Math.floor(n));let l=Math.min(o+a,Math.PI),c=0,h=[],u=new k,d=new k,f=[],g=[],v=[],p=[];for(let m=0;m<=n;m++){let y=[],R=m/n,b=o+R*a,A=e*Math.cos(b),E=Math.sqrt(e*e-A*A),_=0;m===0&&o===0?_=.5/t:m===n&&l===Math.PI&&(_=-.5/t);for(let T=0;T<=t;T++){let O=T/t,I=s+O*r;u.x=-E*Math.cos(I),u.y=A,u.z=E*Math.sin(I),g.push(u.x,u.y,u.z),d.copy(u).normalize(),v.push(d.x,d.y,d.z),p.push(O+_,1-R),y.push(c++)}h.push(y)}for(let m=0;m<n;m++)for(let y=0;y<t;y++){let R=h[m][y+1],b=h[m][y],A=h[m+1][y],E=h[m+1][y+1];(m!==0||o>0)&&f.push(R,b,E),(m!==n-1||l<Math.PI)&&f.push(b,A,E)}this.setIndex(f),this.setAttribute("position",new lt(g,3)),this.setAttribute("normal",new lt(v,3)),this.setAttribute("uv",new lt(p,2))}copy(e){return super.copy(e),this.parameters=Object.assign({},e.parameters),this}static fromJSON(e){return new i(e.radius,e.widthSegments,e.heightSegments,e.phiStart,e.phiLength,e.thetaStart,e.thetaLength)}};function Er(i){let e={};for(let t in i){e[t]={};for(let n in i[t]){let s=i[t][n];if(mp(s))s.isRenderTargetTexture?($e("UniformsUtils: Textures of render targets cannot be cloned via cloneUniforms() or mergeUniforms()."),e[t][n]=null):e[t][n]=s.clone();else if(Array.isArray(s))if(mp(s[0])){let r=[];for(let o=0,a=s.length;o<a;o++)r[o]=s[o].clone();e[t][n]=r}else e[t][n]=s.slice();else e[t][n]=s}}return e}function Wn(i){let e={};for(let t=0;t<i.length;t++){let n=Er(i[t]);for(let s in n)e[s]=n[s]}return e}function mp(i){return i&&(i.isColor||i.isMatrix3||i.isMatrix4||i.isVector2||i.isVector3||i.isVector4||i.isTexture||i.isQuaternion)}function t_(i){let e=[];for(let t=0;t<i.length;t++)e.push(i[t].clone());return e}function id(i){let e=i.getRenderTarget();return e===null?i.outputColorSpace:e.isXRRenderTarget===!0?e.texture.colorSpace:gt.workingColorSpace}var rm={clone:Er,merge:Wn},n_=`void main() {
	gl_Position = projectionMatrix * modelViewMatrix * vec4( position, 1.0 );
}`,i_=`void main() {
	gl_FragColor = vec4( 1.0, 0.0, 0.0, 1.0 );
}`,Wt=class extends Ms{constructor(e){super(),this.isShaderMaterial=!0,this.type="ShaderMaterial",this.defines={},this.uniforms={},this.uniformsGroups=[],this.vertexShader=n_,this.fragmentShader=i_,this.linewidth=1,this.wireframe=!1,this.wireframeLinewidth=1,this.fog=!1,this.lights=!1,this.clipping=!1,this.forceSinglePass=!0,this.extensions={clipCullDistance:!1,multiDraw:!1},this.defaultAttributeValues={color:[1,1,1],uv:[0,0],uv1:[0,0]},this.index0AttributeName=void 0,this.uniformsNeedUpdate=!1,this.glslVersion=null,e!==void 0&&this.setValues(e)}copy(e){return super.copy(e),this.fragmentShader=e.fragmentShader,this.vertexShader=e.vertexShader,this.uniforms=Er(e.uniforms),this.uniformsGroups=t_(e.uniformsGroups),this.defines=Object.assign({},e.defines),this.wireframe=e.wireframe,this.wireframeLinewidth=e.wireframeLinewidth,this.fog=e.fog,this.lights=e.lights,this.clipping=e.clipping,this.extensions=Object.assign({},e.extensions),this.glslVersion=e.glslVersion,this.defaultAttributeValues=Object.assign({},e.defaultAttributeValues),this.index0AttributeName=e.index0AttributeName,this.uniformsNeedUpdate=e.uniformsNeedUpdate,this}toJSON(e){let t=super.toJSON(e);t.glslVersion=this.glslVersion,t.uniforms={};for(let s in this.uniforms){let o=this.uniforms[s].value;o&&o.isTexture?t.uniforms[s]={type:"t",value:o.toJSON(e).uuid}:o&&o.isColor?t.uniforms[s]={type:"c",value:o.getHex()}:o&&o.isVector2?t.uniforms[s]={type:"v2",value:o.toArray()}:o&&o.isVector3?t.uniforms[s]={type:"v3",value:o.toArray()}:o&&o.isVector4?t.uniforms[s]={type:"v4",value:o.toArray()}:o&&o.isMatrix3?t.uniforms[s]={type:"m3",value:o.toArray()}:o&&o.isMatrix4?t.uniforms[s]={type:"m4",value:o.toArray()}:t.uniforms[s]={value:o}}Object.keys(this.defines).length>0&&(t.defines=this.defines),t.vertexShader=this.vertexShader,t.fragmentShader=this.fragmentShader,t.lights=this.lights,t.clipping=this.clipping;let n={};for(let s in this.extensions)this.extensions[s]===!0&&(n[s]=!0);return Object.keys(n).length>0&&(t.extensions=n),t}fromJSON(e,t){if(super.fromJSON(e,t),e.uniforms!==void 0)for(let n in e.uniforms){let s=e.uniforms[n];switch(this.uniforms[n]={},s.type){case"t":this.uniforms[n].value=t[s.value]||null;break;case"c":this.uniforms[n].value=new xt().setHex(s.value);break;case"v2":this.uniforms[n].value=new vt().fromArray(s.value);break;case"v3":this.uniforms[n].value=new k().fromArray(s.value);break;case"v4":this.uniforms[n].value=new en().fromArray(s.value);break;case"m3":this.uniforms[n].value=new qe().fromArray(s.value);break;case"m4":this.uniforms[n].value=new it().fromArray(s.value);break;default:this.uniforms[n].value=s.value}}if(e.defines!==void 0&&(this.defines=e.defines),e.vertexShader!==void 0&&(this.vertexShader=e.vertexShader),e.fragmentShader!==void 0&&(this.fragmentShader=e.fragmentShader),e.glslVersion!==void 0&&(this.glslVersion=e.glslVersion),e.extensions!==void 0)for(let n in e.extensions)this.extensions[n]=e.extensions[n];return e.lights!==void 0&&(this.lights=e.lights),e.clipping!==void 0&&(this.clipping=e.clipping),this}},Wl=class extends Wt{constructor(e){super(e),this.isRawShaderMaterial=!0,this.type="RawShaderMaterial"}};var Xl=class extends Ms{constructor(e){super(),this.isMeshDepthMaterial=!0,this.type="MeshDepthMaterial",this.depthPacking=Wp,this.map=null,this.alphaMap=null,this.displacementMap=null,this.displacementScale=1,this.displacementBias=0,this.wireframe=!1,this.wireframeLinewidth=1,this.setValues(e)}copy(e){return super.copy(e),this.depthPacking=e.depthPacking,this.map=e.map,this.alphaMap=e.alphaMap,this.displacementMap=e.displacementMap,this.displacementScale=e.displacementScale,this.displacementBias=e.displacementBias,this.wireframe=e.wireframe,this.wireframeLinewidth=e.wireframeLinewidth,this}},ql=class extends Ms{constructor(e){super(),this.isMeshDistanceMaterial=!0,this.type="MeshDistanceMaterial",this.map=null,this.alphaMap=null,this.displacementMap=null,this.displacementScale=1,this.displacementBias=0,this.setValues(e)}copy(e){return super.copy(e),this.map=e.map,this.alphaMap=e.alphaMap,this.displacementMap=e.displacementMap,this.displacementScale=e.displacementScale,this.displacementBias=e.displacementBias,this}};function no(i,e){return!i||i.constructor===e?i:typeof e.BYTES_PER_ELEMENT=="number"?new e(i):Array.prototype.slice.call(i)}function bl(i){return i!==void 0&&i.inTangents!==void 0&&i.outTangents!==void 0}var er=class{constructor(e,t,n,s){this.parameterPositions=e,this._cachedIndex=0,this.resultBuffer=s!==void 0?s:new t.constructor(n),this.sampleValues=t,this.valueSize=n,this.settings=null,this.DefaultSettings_={}}evaluate(e){let t=this.parameterPositions,n=this._cachedIndex,s=t[n],r=t[n-1];n:{e:{let o;t:{i:if(!(e<s)){for(let a=n+2;;){if(s===void 0){if(e<r)break i;return n=t.length,this._cachedIndex=n,this.copySampleValue_(n-1)}if(n===a)break;if(r=s,s=t[++n],e<s)break e}o=t.length;break t}if(!(e>=r)){let a=t[1];e<a&&(n=2,r=a);for(let l=n-2;;){if(r===void 0)return this._cachedIndex=0,this.copySampleValue_(0);if(n===l)break;if(s=r,r=t[--n-1],e>=r)break e}o=n,n=0;break t}break n}for(;n<o;){let a=n+o>>>1;e<t[a]?o=a:n=a+1}if(s=t[n],r=t[n-1],r===void 0)return this._cachedIndex=0,this.copySampleValue_(0);if(s===void 0)return n=t.length,this._cachedIndex=n,this.copySampleValue_(n-1)}this._cachedIndex=n,this.intervalChanged_(n,r,s)}return this.interpolate_(n,r,e,s)}getSettings_(){return this.settings||this.DefaultSettings_}copySampleValue_(e){let t=this.resultBuffer,n=this.sampleValues,s=this.valueSize,r=e*s;for(let o=0;o!==s;++o)t[o]=n[r+o];return t}interpolate_(){throw new Error("THREE.Interpolant: Call to abstract method.")}intervalChanged_(){}},Yl=class extends er{constructor(e,t,n,s){super(e,t,n,s),this._weightPrev=-0,this._offsetPrev=-0,this._weightNext=-0,this._offsetNext=-0,this.DefaultSettings_={endingStart:Eu,endingEnd:Eu}}intervalChanged_(e,t,n){let s=this.parameterPositions,r=e-2,o=e+1,a=s[r],l=s[o];if(a===void 0)switch(this.getSettings_().endingStart){case Tu:r=e,a=2*t-n;break;case Au:r=s.length-2,a=t+s[r]-s[r+1];break;default:r=e,a=n}if(l===void 0)switch(this.getSettings_().endingEnd){case Tu:o=e,l=2*n-t;break;case Au:o=1,l=n+s[1]-s[0];break;default:o=e-1,l=t}let c=(n-t)*.5,h=this.valueSize;this._weightPrev=c/(t-a),this._weightNext=c/(l-n),this._offsetPrev=r*h,this._offsetNext=o*h}interpolate_(e,t,n,s){let r=this.resultBuffer,o=this.sampleValues,a=this.valueSize,l=e*a,c=l-a,h=this._offsetPrev,u=this._offsetNext,d=this._weightPrev,f=this._weightNext,g=(n-t)/(s-t),v=g*g,p=v*g,m=-d*p+2*d*v-d*g,y=(1+d)*p+(-1.5-2*d)*v+(-.5+d)*g+1,R=(-1-f)*p+(1.5+f)*v+.5*g,b=f*p-f*v;for(let A=0;A!==a;++A)r[A]=m*o[h+A]+y*o[c+A]+R*o[l+A]+b*o[u+A];return r}},$l=class extends er{constructor(e,t,n,s){super(e,t,n,s)}interpolate_(e,t,n,s){let r=this.resultBuffer,o=this.sampleValues,a=this.valueSize,l=e*a,c=l-a,h=(n-t)/(s-t),u=1-h;for(let d=0;d!==a;++d)r[d]=o[c+d]*u+o[l+d]*h;return r}},Zl=class extends er{constructor(e,t,n,s){super(e,t,n,s)}interpolate_(e){return this.copySampleValue_(e-1)}},Kl=class extends er{interpolate_(e,t,n,s){let r=this.resultBuffer,o=this.sampleValues,a=this.valueSize,l=e*a,c=l-a,h=this.inTangents,u=this.outTangents;if(!h||!u){let g=(n-t)/(s-t),v=1-g;for(let p=0;p!==a;++p)r[p]=o[c+p]*v+o[l+p]*g;return r}let d=a*2,f=e-1;for(let g=0;g!==a;++g){let v=o[c+g],p=o[l+g],m=f*d+g*2,y=u[m],R=u[m+1],b=e*d+g*2,A=h[b],E=h[b+1],_=r_(n,t,y,A,s);r[g]=om(_,v,R,E,p)}return r}};function om(i,e,t,n,s){let r=1-i;return r*r*r*e+3*r*r*i*t+3*r*i*i*n+i*i*i*s}function s_(i,e,t,n,s){let r=1-i;return 3*r*r*(t-e)+6*r*i*(n-t)+3*i*i*(s-n)}function r_(i,e,t,n,s){let r=(i-e)/(s-e);for(let o=0;o<8;o++){let a=om(r,e,t,n,s)-i;if(Math.abs(a)<1e-10)break;let l=s_(r,e,t,n,s);if(Math.abs(l)<1e-10)break;r=Math.max(0,Math.min(1,r-a/l))}return r}var gi=class{constructor(e,t,n,s){if(e===void 0)throw new Error("THREE.KeyframeTrack: track name is undefined");if(t===void 0||t.length===0)throw new Error("THREE.KeyframeTrack: no keyframes in track named "+e);this.name=e,this.times=no(t,this.TimeBufferType),this.values=no(n,this.ValueBufferType),this.setInterpolation(s||this.DefaultInterpolation)}static toJSON(e){let t=e.constructor,n;if(t.toJSON!==this.toJSON)n=t.toJSON(e);else{n={name:e.name,times:no(e.times,Array),values:no(e.values,Array)};let s=e.getInterpolation();s!==e.DefaultInterpolation&&(n.interpolation=s),bl(e.settings)&&(n.settings={inTangents:no(e.settings.inTangents,Array),outTangents:no(e.settings.outTangents,Array)})}return n.type=e.ValueTypeName,n}InterpolantFactoryMethodDiscrete(e){return new Zl(this.times,this.values,this.getValueSize(),e)}InterpolantFactoryMethodLinear(e){return new $l(this.times,this.values,this.getValueSize(),e)}InterpolantFactoryMethodSmooth(e){return new Yl(this.times,this.values,this.getValueSize(),e)}InterpolantFactoryMethodBezier(e){let t=new Kl(this.times,this.values,this.getValueSize(),e);return this.settings&&(t.inTangents=this.settings.inTangents,t.outTangents=this.settings.outTangents),t}setInterpolation(e){let t;switch(e){case Qo:t=this.InterpolantFactoryMethodDiscrete;break;case Nl:t=this.InterpolantFactoryMethodLinear;break;case wl:t=this.InterpolantFactoryMethodSmooth;break;case wu:t=this.InterpolantFactoryMethodBezier;break}if(t===void 0){let n="unsupported interpolation for "+this.ValueTypeName+" keyframe track named "+this.name;if(this.createInterpolant===void 0)if(e!==this.DefaultInterpolation)this.setInterpolation(this.DefaultInterpolation);else throw new Error(n);return $e("KeyframeTrack:",n),this}return this.createInterpolant=t,this}getInterpolation(){switch(this.createInterpolant){case this.InterpolantFactoryMethodDiscrete:return Qo;case this.InterpolantFactoryMethodLinear:return Nl;case this.InterpolantFactoryMethodSmooth:return wl;case this.InterpolantFactoryMethodBezier:return wu}}getValueSize(){return this.values.length/this.times.length}shift(e){if(e!==0){let t=this.times;for(let n=0,s=t.length;n!==s;++n)t[n]+=e;bl(this.settings)&&(gp(this.settings.inTangents,e),gp(this.settings.outTangents,e))}return this}scale(e){if(e!==1){let t=this.times;for(let n=0,s=t.length;n!==s;++n)t[n]*=e;bl(this.settings)&&(vp(this.settings.inTangents,e),vp(this.settings.outTangents,e))}return this}trim(e,t){let n=this.times,s=n.length,r=0,o=s-1;for(;r!==s&&n[r]<e;)++r;for(;o!==-1&&n[o]>t;)--o;if(++o,r!==0||o!==s){r>=o&&(o=Math.max(o,1),r=o-1);let a=this.getValueSize();this.times=n.slice(r,o),this.values=this.values.slice(r*a,o*a)}return this}validate(){let e=!0,t=this.getValueSize();t-Math.floor(t)!==0&&(Qe("KeyframeTrack: Invalid value size in track.",this),e=!1);let n=this.times,s=this.values,r=n.length;r===0&&(Qe("KeyframeTrack: Track is empty.",this),e=!1);let o=null;for(let a=0;a!==r;a++){let l=n[a];if(typeof l=="number"&&isNaN(l)){Qe("KeyframeTrack: Time is not a valid number.",this,a,l),e=!1;break}if(o!==null&&o>l){Qe("KeyframeTrack: Out of order keys.",this,a,l,o),e=!1;break}o=l}if(s!==void 0&&Lv(s))for(let a=0,l=s.length;a!==l;++a){let c=s[a];if(isNaN(c)){Qe("KeyframeTrack: Value is not a valid number.",this,a,c),e=!1;break}}return e}optimize(){let e=this.times.slice(),t=this.values.slice(),n=this.getValueSize(),s=this.getInterpolation()===wl,r=e.length-1,o=1;for(let a=1;a<r;++a){let l=!1,c=e[a],h=e[a+1];if(c!==h&&(a!==1||c!==e[0]))if(s)l=!0;else{let u=a*n,d=u-n,f=u+n;for(let g=0;g!==n;++g){let v=t[u+g];if(v!==t[d+g]||v!==t[f+g]){l=!0;break}}}if(l){if(a!==o){e[o]=e[a];let u=a*n,d=o*n;for(let f=0;f!==n;++f)t[d+f]=t[u+f]}++o}}if(r>0){e[o]=e[r];for(let a=r*n,l=o*n,c=0;c!==n;++c)t[l+c]=t[a+c];++o}return o!==e.length?(this.times=e.slice(0,o),this.values=t.slice(0,o*n)):(this.times=e,this.values=t),this}clone(){let e=this.times.slice(),t=this.values.slice(),n=this.constructor,s=new n(this.name,e,t);return s.createInterpolant=this.createInterpolant,bl(this.settings)&&(s.settings={inTangents:this.settings.inTangents.slice(),outTangents:this.settings.outTangents.slice()}),s}};function gp(i,e){for(let t=0,n=i.length;t!==n;t+=2)i[t]+=e}function vp(i,e){for(let t=0,n=i.length;t!==n;t+=2)i[t]*=e}gi.prototype.ValueTypeName="";gi.prototype.TimeBufferType=Float32Array;gi.prototype.ValueBufferType=Float32Array;gi.prototype.DefaultInterpolation=Nl;var tr=class extends gi{constructor(e,t,n){super(e,t,n)}};tr.prototype.ValueTypeName="bool";tr.prototype.ValueBufferType=Array;tr.prototype.DefaultInterpolation=Qo;tr.prototype.InterpolantFactoryMethodLinear=void 0;tr.prototype.InterpolantFactoryMethodSmooth=void 0;var Jl=class extends gi{constructor(e,t,n,s){super(e,t,n,s)}};Jl.prototype.ValueTypeName="color";var jl=class extends gi{constructor(e,t,n,s){super(e,t,n,s)}};jl.prototype.ValueTypeName="number";var Ql=class extends er{constructor(e,t,n,s){super(e,t,n,s)}interpolate_(e,t,n,s){let r=this.resultBuffer,o=this.sampleValues,a=this.valueSize,l=(n-t)/(s-t),c=e*a;for(let h=c+a;c!==h;c+=4)Vn.slerpFlat(r,0,o,c-a,o,c,l);return r}},ma=class extends gi{constructor(e,t,n,s){super(e,t,n,s)}InterpolantFactoryMethodLinear(e){return new Ql(this.times,this.values,this.getValueSize(),e)}};ma.prototype.ValueTypeName="quaternion";ma.prototype.InterpolantFactoryMethodSmooth=void 0;var nr=class extends gi{constructor(e,t,n){super(e,t,n)}};nr.prototype.ValueTypeName="string";nr.prototype.ValueBufferType=Array;nr.prototype.DefaultInterpolation=Qo;nr.prototype.InterpolantFactoryMethodLinear=void 0;nr.prototype.InterpolantFactoryMethodSmooth=void 0;var ec=class extends gi{constructor(e,t,n,s){super(e,t,n,s)}};ec.prototype.ValueTypeName="vector";var tc=class{constructor(e,t,n){let s=this,r=!1,o=0,a=0,l,c=[];this.onStart=void 0,this.onLoad=e,this.onProgress=t,this.onError=n,this._abortController=null,this.itemStart=function(h){a++,r===!1&&s.onStart!==void 0&&s.onStart(h,o,a),r=!0},this.itemEnd=function(h){o++,s.onProgress!==void 0&&s.onProgress(h,o,a),o===a&&(r=!1,s.onLoad!==void 0&&s.onLoad())},this.itemError=function(h){s.onError!==void 0&&s.onError(h)},this.resolveURL=function(h){return h=h.normalize("NFC"),l?l(h):h},this.setURLModifier=function(h){return l=h,this},this.addHandler=function(h,u){return c.push(h,u),this},this.removeHandler=function(h){let u=c.indexOf(h);return u!==-1&&c.splice(u,2),this},this.getHandler=function(h){for(let u=0,d=c.length;u<d;u+=2){let f=c[u],g=c[u+1];if(f.global&&(f.lastIndex=0),f.test(h))return g}return null},this.abort=function(){return this.abortController.abort(),this._abortController=null,this}}get abortController(){return this._abortController||(this._abortController=new AbortController),this._abortController}},am=new tc,nc=class{constructor(e){this.manager=e!==void 0?e:am,this.crossOrigin="anonymous",this.withCredentials=!1,this.path="",this.resourcePath="",this.requestHeader={},this.priority="auto",this.cache="default",typeof __THREE_DEVTOOLS__<"u"&&__THREE_DEVTOOLS__.dispatchEvent(new CustomEvent("observe",{detail:this}))}load(){}loadAsync(e,t){let n=this;return new Promise(function(s,r){n.load(e,s,t,r)})}parse(){}setCrossOrigin(e){return this.crossOrigin=e,this}setWithCredentials(e){return this.withCredentials=e,this}setPath(e){return this.path=e,this}setResourcePath(e){return this.resourcePath=e,this}setRequestHeader(e){return this.requestHeader=e,this}setPriority(e){return this.priority=e,this}setCache(e){return this.cache=e,this}abort(){return this}};nc.DEFAULT_MATERIAL_NAME="__DEFAULT";var Sl=new k,Ml=new Vn,es=new k,xr=class extends ei{constructor(){super(),this.isCamera=!0,this.type="Camera",this.matrixWorldInverse=new it,this.projectionMatrix=new it,this.projectionMatrixInverse=new it,this.coordinateSystem=Ci,this._reversedDepth=!1}get reversedDepth(){return this._reversedDepth}copy(e,t){return super.copy(e,t),this.matrixWorldInverse.copy(e.matrixWorldInverse),this.projectionMatrix.copy(e.projectionMatrix),this.projectionMatrixInverse.copy(e.projectionMatrixInverse),this.coordinateSystem=e.coordinateSystem,this}getWorldDirection(e){return super.getWorldDirection(e).negate()}updateMatrixWorld(e){super.updateMatrixWorld(e),this.matrixWorld.decompose(Sl,Ml,es),es.x===1&&es.y===1&&es.z===1?this.matrixWorldInverse.copy(this.matrixWorld).invert():this.matrixWorldInverse.compose(Sl,Ml,es.set(1,1,1)).invert()}updateWorldMatrix(e,t,n=!1){super.updateWorldMatrix(e,t,n),this.matrixWorld.decompose(Sl,Ml,es),es.x===1&&es.y===1&&es.z===1?this.matrixWorldInverse.copy(this.matrixWorld).invert():this.matrixWorldInverse.compose(Sl,Ml,es.set(1,1,1)).invert()}clone(){return new this.constructor().copy(this)}},$s=new k,_p=new vt,xp=new vt,pi=class extends xr{constructor(e=50,t=1,n=.1,s=2e3){super(),this.isPerspectiveCamera=!0,this.type="PerspectiveCamera",this.fov=e,this.zoom=1,this.near=n,this.far=s,this.focus=10,this.aspect=t,this.view=null,this.filmGauge=35,this.filmOffset=0,this.updateProjectionMatrix()}copy(e,t){return super.copy(e,t),this.fov=e.fov,this.zoom=e.zoom,this.near=e.near,this.far=e.far,this.focus=e.focus,this.aspect=e.aspect,this.view=e.view===null?null:Object.assign({},e.view),this.filmGauge=e.filmGauge,this.filmOffset=e.filmOffset,this}setFocalLength(e){let t=.5*this.getFilmHeight()/e;this.fov=Fl*2*Math.atan(t),this.updateProjectionMatrix()}getFocalLength(){let e=Math.tan(nu*.5*this.fov);return .5*this.getFilmHeight()/e}getEffectiveFOV(){return Fl*2*Math.atan(Math.tan(nu*.5*this.fov)/this.zoom)}getFilmWidth(){return this.filmGauge*Math.min(this.aspect,1)}getFilmHeight(){return this.filmGauge/Math.max(this.aspect,1)}getViewBounds(e,t,n){$s.set(-1,-1,.5).applyMatrix4(this.projectionMatrixInverse),t.set($s.x,$s.y).multiplyScalar(-e/$s.z),$s.set(1,1,.5).applyMatrix4(this.projectionMatrixInverse),n.set($s.x,$s.y).multiplyScalar(-e/$s.z)}getViewSize(e,t){return this.getViewBounds(e,_p,xp),t.subVectors(xp,_p)}setViewOffset(e,t,n,s,r,o){this.aspect=e/t,this.view===null&&(this.view={enabled:!0,fullWidth:1,fullHeight:1,offsetX:0,offsetY:0,width:1,height:1}),this.view.enabled=!0,this.view.fullWidth=e,this.view.fullHeight=t,this.view.offsetX=n,this.view.offsetY=s,this.view.width=r,this.view.height=o,this.updateProjectionMatrix()}clearViewOffset(){this.view!==null&&(this.view.enabled=!1),this.updateProjectionMatrix()}updateProjectionMatrix(){let e=this.near,t=e*Math.tan(nu*.5*this.fov)/this.zoom,n=2*t,s=this.aspect*n,r=-.5*s,o=this.view;if(this.view!==null&&this.view.enabled){let l=o.fullWidth,c=o.fullHeight;r+=o.offsetX*s/l,t-=o.offsetY*n/c,s*=o.width/l,n*=o.height/c}let a=this.filmOffset;a!==0&&(r+=e*a/this.getFilmWidth()),this.projectionMatrix.makePerspective(r,r+s,t,t-n,e,this.far,this.coordinateSystem,this.reversedDepth),this.projectionMatrixInverse.copy(this.projectionMatrix).invert()}toJSON(e){let t=super.toJSON(e);return t.object.fov=this.fov,t.object.zoom=this.zoom,t.object.near=this.near,t.object.far=this.far,t.object.focus=this.focus,t.object.aspect=this.aspect,this.view!==null&&(t.object.view=Object.assign({},this.view)),t.object.filmGauge=this.filmGauge,t.object.filmOffset=this.filmOffset,t}};var mo=class extends xr{constructor(e=-1,t=1,n=1,s=-1,r=.1,o=2e3){super(),this.isOrthographicCamera=!0,this.type="OrthographicCamera",this.zoom=1,this.view=null,this.left=e,this.right=t,this.top=n,this.bottom=s,this.near=r,this.far=o,this.updateProjectionMatrix()}copy(e,t){return super.copy(e,t),this.left=e.left,this.right=e.right,this.top=e.top,this.bottom=e.bottom,this.near=e.near,this.far=e.far,this.zoom=e.zoom,this.view=e.view===null?null:Object.assign({},e.view),this}setViewOffset(e,t,n,s,r,o){this.view===null&&(this.view={enabled:!0,fullWidth:1,fullHeight:1,offsetX:0,offsetY:0,width:1,height:1}),this.view.enabled=!0,this.view.fullWidth=e,this.view.fullHeight=t,this.view.offsetX=n,this.view.offsetY=s,this.view.width=r,this.view.height=o,this.updateProjectionMatrix()}clearViewOffset(){this.view!==null&&(this.view.enabled=!1),this.updateProjectionMatrix()}updateProjectionMatrix(){let e=(this.right-this.left)/(2*this.zoom),t=(this.top-this.bottom)/(2*this.zoom),n=(this.right+this.left)/2,s=(this.top+this.bottom)/2,r=n-e,o=n+e,a=s+t,l=s-t;if(this.view!==null&&this.view.enabled){let c=(this.right-this.left)/this.view.fullWidth/this.zoom,h=(this.top-this.bottom)/this.view.fullHeight/this.zoom;r+=c*this.view.offsetX,o=r+c*this.view.width,a-=h*this.view.offsetY,l=a-h*this.view.height}this.projectionMatrix.makeOrthographic(r,o,a,l,this.near,this.far,this.coordinateSystem,this.reversedDepth),this.projectionMatrixInverse.copy(this.projectionMatrix).invert()}toJSON(e){let t=super.toJSON(e);return t.object.zoom=this.zoom,t.object.left=this.left,t.object.right=this.right,t.object.top=this.top,t.object.bottom=this.bottom,t.object.near=this.near,t.object.far=this.far,this.view!==null&&(t.object.view=Object.assign({},this.view)),t}};var yr=class extends zt{constructor(){super(),this.isInstancedBufferGeometry=!0,this.type="InstancedBufferGeometry",this.instanceCount=1/0}copy(e){return super.copy(e),this.instanceCount=e.instanceCount,this}toJSON(){let e=super.toJSON();return e.instanceCount=this.instanceCount,e.isInstancedBufferGeometry=!0,e}};var io=-90,so=1,go=class extends ei{constructor(e,t,n){super(),this.type="CubeCamera",this.renderTarget=n,this.coordinateSystem=null,this.activeMipmapLevel=0;let s=new pi(io,so,e,t);s.layers=this.layers,this.add(s);let r=new pi(io,so,e,t);r.layers=this.layers,this.add(r);let o=new pi(io,so,e,t);o.layers=this.layers,this.add(o);let a=new pi(io,so,e,t);a.layers=this.layers,this.add(a);let l=new pi(io,so,e,t);l.layers=this.layers,this.add(l);let c=new pi(io,so,e,t);c.layers=this.layers,this.add(c)}updateCoordinateSystem(){let e=this.coordinateSystem,t=this.children.concat(),[n,s,r,o,a,l]=t;for(let c of t)this.remove(c);if(e===Ci)n.up.set(0,1,0),n.lookAt(1,0,0),s.up.set(0,1,0),s.lookAt(-1,0,0),r.up.set(0,0,-1),r.lookAt(0,1,0),o.up.set(0,0,1),o.lookAt(0,-1,0),a.up.set(0,1,0),a.lookAt(0,0,1),l.up.set(0,1,0),l.lookAt(0,0,-1);else if(e===ta)n.up.set(0,-1,0),n.lookAt(-1,0,0),s.up.set(0,-1,0),s.lookAt(1,0,0),r.up.set(0,0,1),r.lookAt(0,1,0),o.up.set(0,0,-1),o.lookAt(0,-1,0),a.up.set(0,-1,0),a.lookAt(0,0,1),l.up.set(0,-1,0),l.lookAt(0,0,-1);else throw new Error("THREE.CubeCamera.updateCoordinateSystem(): Invalid coordinate system: "+e);for(let c of t)this.add(c),c.updateMatrixWorld()}update(e,t){this.parent===null&&this.updateMatrixWorld();let{renderTarget:n,activeMipmapLevel:s}=this;this.coordinateSystem!==e.coordinateSystem&&(this.coordinateSystem=e.coordinateSystem,this.updateCoordinateSystem());let[r,o,a,l,c,h]=this.children,u=e.getRenderTarget(),d=e.getActiveCubeFace(),f=e.getActiveMipmapLevel(),g=e.xr.enabled;e.xr.enabled=!1;let v=n.texture.mipmapsAutoUpdate;n.texture.mipmapsAutoUpdate=!1;let p=!1;e.isWebGLRenderer===!0?p=e.state.buffers.depth.getReversed():p=e.reversedDepthBuffer,e.setRenderTarget(n,0,s),p&&e.autoClear===!1&&e.clearDepth(),e.render(t,r),e.setRenderTarget(n,1,s),p&&e.autoClear===!1&&e.clearDepth(),e.render(t,o),e.setRenderTarget(n,2,s),p&&e.autoClear===!1&&e.clearDepth(),e.render(t,a),e.setRenderTarget(n,3,s),p&&e.autoClear===!1&&e.clearDepth(),e.render(t,l),e.setRenderTarget(n,4,s),p&&e.autoClear===!1&&e.clearDepth(),e.render(t,c),n.texture.mipmapsAutoUpdate=v,e.setRenderTarget(n,5,s),p&&e.autoClear===!1&&e.clearDepth(),e.render(t,h),e.setRenderTarget(u,d,f),e.xr.enabled=g,n.texture.needsPMREMUpdate=!0}},ic=class extends pi{constructor(e=[]){super(),this.isArrayCamera=!0,this.isMultiViewCamera=!1,this.cameras=e,this.perCameraFrustumCulled=!1}};var sd="\\[\\]\\.:\\/",o_=new RegExp("["+sd+"]","g"),rd="[^"+sd+"]",a_="[^"+sd.replace("\\.","")+"]",l_=/((?:WC+[\/:])*)/.source.replace("WC",rd),c_=/(WCOD+)?/.source.replace("WCOD",a_),h_=/(?:\.(WC+)(?:\[(.+)\])?)?/.source.replace("WC",rd),u_=/\.(WC+)(?:\[(.+)\])?/.source.replace("WC",rd),d_=new RegExp("^"+l_+c_+h_+u_+"$"),f_=["material","materials","bones","map"],Cu=class{constructor(e,t,n){let s=n||Zt.parseTrackName(t);this._targetGroup=e,this._bindings=e.subscribe_(t,s)}getValue(e,t){this.bind();let n=this._targetGroup.nCachedObjects_,s=this._bindings[n];s!==void 0&&s.getValue(e,t)}setValue(e,t){let n=this._bindings;for(let s=this._targetGroup.nCachedObjects_,r=n.length;s!==r;++s)n[s].setValue(e,t)}bind(){let e=this._bindings;for(let t=this._targetGroup.nCachedObjects_,n=e.length;t!==n;++t)e[t].bind()}unbind(){let e=this._bindings;for(let t=this._targetGroup.nCachedObjects_,n=e.length;t!==n;++t)e[t].unbind()}},Zt=class i{constructor(e,t,n){this.path=t,this.parsedPath=n||i.parseTrackName(t),this.node=i.findNode(e,this.parsedPath.nodeName),this.rootNode=e,this.getValue=this._getValue_unbound,this.setValue=this._setValue_unbound}static create(e,t,n){return e&&e.isAnimationObjectGroup?new i.Composite(e,t,n):new i(e,t,n)}static sanitizeNodeName(e){return e.replace(/\s/g,"_").replace(o_,"")}static parseTrackName(e){let t=d_.exec(e);if(t===null)throw new Error("THREE.PropertyBinding: Cannot parse trackName: "+e);let n={nodeName:t[2],objectName:t[3],objectIndex:t[4],propertyName:t[5],propertyIndex:t[6]},s=n.nodeName&&n.nodeName.lastIndexOf(".");if(s!==void 0&&s!==-1){let r=n.nodeName.substring(s+1);f_.indexOf(r)!==-1&&(n.nodeName=n.nodeName.substring(0,s),n.objectName=r)}if(n.propertyName===null||n.propertyName.length===0)throw new Error("THREE.PropertyBinding: can not parse propertyName from trackName: "+e);return n}static findNode(e,t){if(t===void 0||t===""||t==="."||t===-1||t===e.name||t===e.uuid)return e;if(e.skeleton){let n=e.skeleton.getBoneByName(t);if(n!==void 0)return n}if(e.children){let n=function(r){for(let o=0;o<r.length;o++){let a=r[o];if(a.name===t||a.uuid===t)return a;let l=n(a.children);if(l)return l}return null},s=n(e.children);if(s)return s}return null}_getValue_unavailable(){}_setValue_unavailable(){}_getValue_direct(e,t){e[t]=this.targetObject[this.propertyName]}_getValue_array(e,t){let n=this.resolvedProperty;for(let s=0,r=n.length;s!==r;++s)e[t++]=n[s]}_getValue_arrayElement(e,t){e[t]=this.resolvedProperty[this.propertyIndex]}_getValue_toArray(e,t){this.resolvedProperty.toArray(e,t)}_setValue_direct(e,t){this.targetObject[this.propertyName]=e[t]}_setValue_direct_setNeedsUpdate(e,t){this.targetObject[this.propertyName]=e[t],this.targetObject.needsUpdate=!0}_setValue_direct_setMatrixWorldNeedsUpdate(e,t){this.targetObject[this.propertyName]=e[t],this.targetObject.matrixWorldNeedsUpdate=!0}_setValue_array(e,t){let n=this.resolvedProperty;for(let s=0,r=n.length;s!==r;++s)n[s]=e[t++]}_setValue_array_setNeedsUpdate(e,t){let n=this.resolvedProperty;for(let s=0,r=n.length;s!==r;++s)n[s]=e[t++];this.targetObject.needsUpdate=!0}_setValue_array_setMatrixWorldNeedsUpdate(e,t){let n=this.resolvedProperty;for(let s=0,r=n.length;s!==r;++s)n[s]=e[t++];this.targetObject.matrixWorldNeedsUpdate=!0}_setValue_arrayElement(e,t){this.resolvedProperty[this.propertyIndex]=e[t]}_setValue_arrayElement_setNeedsUpdate(e,t){this.resolvedProperty[this.propertyIndex]=e[t],this.targetObject.needsUpdate=!0}_setValue_arrayElement_setMatrixWorldNeedsUpdate(e,t){this.resolvedProperty[this.propertyIndex]=e[t],this.targetObject.matrixWorldNeedsUpdate=!0}_setValue_fromArray(e,t){this.resolvedProperty.fromArray(e,t)}_setValue_fromArray_setNeedsUpdate(e,t){this.resolvedProperty.fromArray(e,t),this.targetObject.needsUpdate=!0}_setValue_fromArray_setMatrixWorldNeedsUpdate(e,t){this.resolvedProperty.fromArray(e,t),this.targetObject.matrixWorldNeedsUpdate=!0}_getValue_unbound(e,t){this.bind(),this.getValue(e,t)}_setValue_unbound(e,t){this.bind(),this.setValue(e,t)}bind(){let e=this.node,t=this.parsedPath,n=t.objectName,s=t.propertyName,r=t.propertyIndex;if(e||(e=i.findNode(this.rootNode,t.nodeName),this.node=e),this.getValue=this._getValue_unavailable,this.setValue=this._setValue_unavailable,!e){$e("PropertyBinding: No target node found for track: "+this.path+".");return}if(n){let c=t.objectIndex;switch(n){case"materials":if(!e.material){Qe("PropertyBinding: Can not bind to material as node does not have a material.",this);return}if(!e.material.materials){Qe("PropertyBinding: Can not bind to material.materials as node.material does not have a materials array.",this);return}e=e.material.materials;break;case"bones":if(!e.skeleton){Qe("PropertyBinding: Can not bind to bones as node does not have a skeleton.",this);return}e=e.skeleton.bones;for(let h=0;h<e.length;h++)if(e[h].name===c){c=h;break}break;case"map":if("map"in e){e=e.map;break}if(!e.material){Qe("PropertyBinding: Can not bind to material as node does not have a material.",this);return}if(!e.material.map){Qe("PropertyBinding: Can not bind to material.map as node.material does not have a map.",this);return}e=e.material.map;break;default:if(e[n]===void 0){Qe("PropertyBinding: Can not bind to objectName of node undefined.",this);return}e=e[n]}if(c!==void 0){if(e[c]===void 0){Qe("PropertyBinding: Trying to bind to objectIndex of objectName, but is undefined.",this,e);return}e=e[c]}}let o=e[s];if(o===void 0){let c=t.nodeName;Qe("PropertyBinding: Trying to update property for track: "+c+"."+s+" but it wasn't found.",e);return}let a=this.Versioning.None;this.targetObject=e,e.isMaterial===!0?a=this.Versioning.NeedsUpdate:e.isObject3D===!0&&(a=this.Versioning.MatrixWorldNeedsUpdate);let l=this.BindingType.Direct;if(r!==void 0){if(s==="morphTargetInfluences"){if(!e.geometry){Qe("PropertyBinding: Can not bind to morphTargetInfluences because node does not have a geometry.",this);return}if(!e.geometry.morphAttributes){Qe("PropertyBinding: Can not bind to morphTargetInfluences because node does not have a geometry.morphAttributes.",this);return}e.morphTargetDictionary[r]!==void 0&&(r=e.morphTargetDictionary[r])}l=this.BindingType.ArrayElement,this.resolvedProperty=o,this.propertyIndex=r}else o.fromArray!==void 0&&o.toArray!==void 0?(l=this.BindingType.HasFromToArray,this.resolvedProperty=o):Array.isArray(o)?(l=this.BindingType.EntireArray,this.resolvedProperty=o):this.propertyName=s;this.getValue=this.GetterByBindingType[l],this.setValue=this.SetterByBindingTypeAndVersioning[l][a]}unbind(){this.node=null,this.getValue=this._getValue_unbound,this.setValue=this._setValue_unbound}};Zt.Composite=Cu;Zt.prototype.BindingType={Direct:0,EntireArray:1,ArrayElement:2,HasFromToArray:3};Zt.prototype.Versioning={None:0,NeedsUpdate:1,MatrixWorldNeedsUpdate:2};Zt.prototype.GetterByBindingType=[Zt.prototype._getValue_direct,Zt.prototype._getValue_array,Zt.prototype._getValue_arrayElement,Zt.prototype._getValue_toArray];Zt.prototype.SetterByBindingTypeAndVersioning=[[Zt.prototype._setValue_direct,Zt.prototype._setValue_direct_setNeedsUpdate,Zt.prototype._setValue_direct_setMatrixWorldNeedsUpdate],[Zt.prototype._setValue_array,Zt.prototype._setValue_array_setNeedsUpdate,Zt.prototype._setValue_array_setMatrixWorldNeedsUpdate],[Zt.prototype._setValue_arrayElement,Zt.prototype._setValue_arrayElement_setNeedsUpdate,Zt.prototype._setValue_arrayElement_setMatrixWorldNeedsUpdate],[Zt.prototype._setValue_fromArray,Zt.prototype._setValue_fromArray_setNeedsUpdate,Zt.prototype._setValue_fromArray_setMatrixWorldNeedsUpdate]];var G1=new Float32Array(1);var Pu=class{static{this.prototype.isMatrix2=!0}constructor(e,t,n,s){this.elements=[1,0,0,1],e!==void 0&&this.set(e,t,n,s)}identity(){return this.set(1,0,0,1),this}fromArray(e,t=0){for(let n=0;n<4;n++)this.elements[n]=e[n+t];return this}set(e,t,n,s){let r=this.elements;return r[0]=e,r[2]=t,r[1]=n,r[3]=s,this}};function od(i,e,t,n){let s=p_(n);switch(t){case $u:return i*e;case hc:return i*e/s.components*s.byteLength;case uc:return i*e/s.components*s.byteLength;case sr:return i*e*2/s.components*s.byteLength;case dc:return i*e*2/s.components*s.byteLength;case Zu:return i*e*3/s.components*s.byteLength;case yi:return i*e*4/s.components*s.byteLength;case yo:return i*e*4/s.components*s.byteLength;case ya:case ba:return Math.floor((i+3)/4)*Math.floor((e+3)/4)*8;case Sa:case Ma:return Math.floor((i+3)/4)*Math.floor((e+3)/4)*16;case pc:case gc:return Math.max(i,16)*Math.max(e,8)/4;case fc:case mc:return Math.max(i,8)*Math.max(e,8)/2;case vc:case _c:case yc:case bc:return Math.floor((i+3)/4)*Math.floor((e+3)/4)*8;case xc:case wa:case Sc:return Math.floor((i+3)/4)*Math.floor((e+3)/4)*16;case Mc:return Math.floor((i+3)/4)*Math.floor((e+3)/4)*16;case wc:return Math.floor((i+4)/5)*Math.floor((e+3)/4)*16;case Ec:return Math.floor((i+4)/5)*Math.floor((e+4)/5)*16;case Tc:return Math.floor((i+5)/6)*Math.floor((e+4)/5)*16;case Ac:return Math.floor((i+5)/6)*Math.floor((e+5)/6)*16;case Rc:return Math.floor((i+7)/8)*Math.floor((e+4)/5)*16;case Cc:return Math.floor((i+7)/8)*Math.floor((e+5)/6)*16;case Pc:return Math.floor((i+7)/8)*Math.floor((e+7)/8)*16;case Ic:return Math.floor((i+9)/10)*Math.floor((e+4)/5)*16;case Lc:return Math.floor((i+9)/10)*Math.floor((e+5)/6)*16;case Dc:return Math.floor((i+9)/10)*Math.floor((e+7)/8)*16;case Nc:return Math.floor((i+9)/10)*Math.floor((e+9)/10)*16;case Fc:return Math.floor((i+11)/12)*Math.floor((e+9)/10)*16;case Uc:return Math.floor((i+11)/12)*Math.floor((e+11)/12)*16;case Oc:case Bc:case kc:return Math.ceil(i/4)*Math.ceil(e/4)*16;case zc:case Hc:return Math.ceil(i/4)*Math.ceil(e/4)*8;case Ea:case Vc:return Math.ceil(i/4)*Math.ceil(e/4)*16}throw new Error(`Unable to determine texture byte length for ${t} format.`)}function p_(i){switch(i){case _i:case Xu:return{byteLength:1,components:1};case xo:case xa:case Vi:return{byteLength:2,components:1};case lc:case cc:return{byteLength:2,components:4};case xi:case ac:case ti:return{byteLength:4,components:1};case qu:case Yu:return{byteLength:4,components:3}}throw new Error(`THREE.TextureUtils: Unknown texture type ${i}.`)}typeof __THREE_DEVTOOLS__<"u"&&__THREE_DEVTOOLS__.dispatchEvent(new CustomEvent("register",{detail:{revision:"187"}}));typeof window<"u"&&(window.__THREE__?$e("WARNING: Multiple instances of Three.js being imported."):window.__THREE__="187");/**
 * @license
 * Copyright 2010-2026 Three.js Authors
 * SPDX-License-Identifier: MIT
 */function Cm(){let i=null,e=!1,t=null,n=null;function s(r,o){n=i.requestAnimationFrame(s),t(r,o)}return{start:function(){e!==!0&&t!==null&&i!==null&&(n=i.requestAnimationFrame(s),e=!0)},stop:function(){i!==null&&i.cancelAnimationFrame(n),e=!1},setAnimationLoop:function(r){t=r},setContext:function(r){i=r}}}function g_(i){let e=new WeakMap;function t(a,l){let c=a.array,h=a.usage,u=c.byteLength,d=i.createBuffer();i.bindBuffer(l,d),i.bufferData(l,c,h),a.onUploadCallback();let f;if(c instanceof Float32Array)f=i.FLOAT;else if(typeof Float16Array<"u"&&c instanceof Float16Array)f=i.HALF_FLOAT;else if(c instanceof Uint16Array)a.isFloat16BufferAttribute?f=i.HALF_FLOAT:f=i.UNSIGNED_SHORT;else if(c instanceof Int16Array)f=i.SHORT;else if(c instanceof Uint32Array)f=i.UNSIGNED_INT;else if(c instanceof Int32Array)f=i.INT;else if(c instanceof Int8Array)f=i.BYTE;else if(c instanceof Uint8Array)f=i.UNSIGNED_BYTE;else if(c instanceof Uint8ClampedArray)f=i.UNSIGNED_BYTE;else throw new Error("THREE.WebGLAttributes: Unsupported buffer data format: "+c);return{buffer:d,type:f,bytesPerElement:c.BYTES_PER_ELEMENT,version:a.version,size:u}}function n(a,l,c){let h=l.array,u=l.updateRanges;if(i.bindBuffer(c,a),u.length===0)i.bufferSubData(c,0,h);else{u.sort((f,g)=>f.start-g.start);let d=0;for(let f=1;f<u.length;f++){let g=u[d],v=u[f];v.start<=g.start+g.count+1?g.count=Math.max(g.count,v.start+v.count-g.start):(++d,u[d]=v)}u.length=d+1;for(let f=0,g=u.length;f<g;f++){let v=u[f];i.bufferSubData(c,v.start*h.BYTES_PER_ELEMENT,h,v.start,v.count)}l.clearUpdateRanges()}l.onUploadCallback()}function s(a){return a.isInterleavedBufferAttribute&&(a=a.data),e.get(a)}function r(a){a.isInterleavedBufferAttribute&&(a=a.data);let l=e.get(a);l&&(i.deleteBuffer(l.buffer),e.delete(a))}function o(a,l){if(a.isInterleavedBufferAttribute&&(a=a.data),a.isGLBufferAttribute){let h=e.get(a);(!h||h.version<a.version)&&e.set(a,{buffer:a.buffer,type:a.type,bytesPerElement:a.elementSize,version:a.version});return}let c=e.get(a);if(c===void 0)e.set(a,t(a,l));else if(c.version<a.version){if(c.size!==a.array.byteLength)throw new Error("THREE.WebGLAttributes: The size of the buffer attribute's array buffer does not match the original size. Resizing buffer attributes is not supported.");n(c.buffer,a,l),c.version=a.version}}return{get:s,remove:r,update:o}}var v_=`#ifdef USE_ALPHAHASH
	if ( diffuseColor.a < getAlphaHashThreshold( vPosition ) ) discard;
#endif`,__=`#ifdef USE_ALPHAHASH
	const float ALPHA_HASH_SCALE = 0.05;
	float hash2D( vec2 value ) {
		return fract( 1.0e4 * sin( 17.0 * value.x + 0.1 * value.y ) * ( 0.1 + abs( sin( 13.0 * value.y + value.x ) ) ) );
	}
	float hash3D( vec3 value ) {
		return hash2D( vec2( hash2D( value.xy ), value.z ) );
	}
	float getAlphaHashThreshold( vec3 position ) {
		float maxDeriv = max(
			length( dFdx( position.xyz ) ),
			length( dFdy( position.xyz ) )
		);
		float pixScale = 1.0 / ( ALPHA_HASH_SCALE * maxDeriv );
		vec2 pixScales = vec2(
			exp2( floor( log2( pixScale ) ) ),
			exp2( ceil( log2( pixScale ) ) )
		);
		vec2 alpha = vec2(
			hash3D( floor( pixScales.x * position.xyz ) ),
			hash3D( floor( pixScales.y * position.xyz ) )
		);
		float lerpFactor = fract( log2( pixScale ) );
		float x = ( 1.0 - lerpFactor ) * alpha.x + lerpFactor * alpha.y;
		float a = min( lerpFactor, 1.0 - lerpFactor );
		vec3 cases = vec3(
			x * x / ( 2.0 * a * ( 1.0 - a ) ),
			( x - 0.5 * a ) / ( 1.0 - a ),
			1.0 - ( ( 1.0 - x ) * ( 1.0 - x ) / ( 2.0 * a * ( 1.0 - a ) ) )
		);
		float threshold = ( x < ( 1.0 - a ) )
			? ( ( x < a ) ? cases.x : cases.y )
			: cases.z;
		return clamp( threshold , 1.0e-6, 1.0 );
	}
#endif`,x_=`#ifdef USE_ALPHAMAP
	diffuseColor.a *= texture2D( alphaMap, vAlphaMapUv ).g;
#endif`,y_=`#ifdef USE_ALPHAMAP
	uniform sampler2D alphaMap;
#endif`,b_=`#ifdef USE_ALPHATEST
	#ifdef ALPHA_TO_COVERAGE
	diffuseColor.a = smoothstep( alphaTest, alphaTest + fwidth( diffuseColor.a ), diffuseColor.a );
	if ( diffuseColor.a == 0.0 ) discard;
	#else
	if ( diffuseColor.a < alphaTest ) discard;
	#endif
#endif`,S_=`#ifdef USE_ALPHATEST
	uniform float alphaTest;
#endif`,M_=`#ifdef USE_AOMAP
	float ambientOcclusion = ( texture2D( aoMap, vAoMapUv ).r - 1.0 ) * aoMapIntensity + 1.0;
	reflectedLight.indirectDiffuse *= ambientOcclusion;
	#if defined( USE_CLEARCOAT ) 
		clearcoatSpecularIndirect *= ambientOcclusion;
	#endif
	#if defined( USE_SHEEN ) 
		sheenSpecularIndirect *= ambientOcclusion;
	#endif
	#if defined( USE_ENVMAP ) && defined( STANDARD )
		float dotNV = saturate( dot( geometryNormal, geometryViewDir ) );
		reflectedLight.indirectSpecular *= computeSpecularOcclusion( dotNV, ambientOcclusion, material.roughness );
	#endif
#endif`,w_=`#ifdef USE_AOMAP
	uniform sampler2D aoMap;
	uniform float aoMapIntensity;
#endif`,E_=`#ifdef USE_BATCHING
	#if ! defined( GL_ANGLE_multi_draw )
	#define gl_DrawID _gl_DrawID
	uniform int _gl_DrawID;
	#endif
	uniform highp sampler2D batchingTexture;
	uniform highp usampler2D batchingIdTexture;
	mat4 getBatchingMatrix( const in float i ) {
		int size = textureSize( batchingTexture, 0 ).x;
		int j = int( i ) * 4;
		int x = j % size;
		int y = j / size;
		vec4 v1 = texelFetch( batchingTexture, ivec2( x, y ), 0 );
		vec4 v2 = texelFetch( batchingTexture, ivec2( x + 1, y ), 0 );
		vec4 v3 = texelFetch( batchingTexture, ivec2( x + 2, y ), 0 );
		vec4 v4 = texelFetch( batchingTexture, ivec2( x + 3, y ), 0 );
		return mat4( v1, v2, v3, v4 );
	}
	float getIndirectIndex( const in int i ) {
		int size = textureSize( batchingIdTexture, 0 ).x;
		int x = i % size;
		int y = i / size;
		return float( texelFetch( batchingIdTexture, ivec2( x, y ), 0 ).r );
	}
#endif
#ifdef USE_BATCHING_COLOR
	uniform sampler2D batchingColorTexture;
	vec4 getBatchingColor( const in float i ) {
		int size = textureSize( batchingColorTexture, 0 ).x;
		int j = int( i );
		int x = j % size;
		int y = j / size;
		return texelFetch( batchingColorTexture, ivec2( x, y ), 0 );
	}
#endif`,T_=`#ifdef USE_BATCHING
	mat4 batchingMatrix = getBatchingMatrix( getIndirectIndex( gl_DrawID ) );
#endif`,A_=`vec3 transformed = vec3( position );
#ifdef USE_ALPHAHASH
	vPosition = vec3( position );
#endif`,R_=`vec3 objectNormal = vec3( normal );
#ifdef USE_TANGENT
	vec3 objectTangent = vec3( tangent.xyz );
#endif`,C_=`float G_BlinnPhong_Implicit( ) {
	return 0.25;
}
float D_BlinnPhong( const in float shininess, const in float dotNH ) {
	return RECIPROCAL_PI * ( shininess * 0.5 + 1.0 ) * pow( dotNH, shininess );
}
vec3 BRDF_BlinnPhong( const in vec3 lightDir, const in vec3 viewDir, const in vec3 normal, const in vec3 specularColor, const in float shininess ) {
	vec3 halfDir = normalize( lightDir + viewDir );
	float dotNH = saturate( dot( normal, halfDir ) );
	float dotVH = saturate( dot( viewDir, halfDir ) );
	vec3 F = F_Schlick( specularColor, 1.0, dotVH );
	float G = G_BlinnPhong_Implicit( );
	float D = D_BlinnPhong( shininess, dotNH );
	return F * ( G * D );
} // validated`,P_=`#ifdef USE_IRIDESCENCE
	const mat3 XYZ_TO_REC709 = mat3(
		 3.2404542, -0.9692660,  0.0556434,
		-1.5371385,  1.8760108, -0.2040259,
		-0.4985314,  0.0415560,  1.0572252
	);
	vec3 Fresnel0ToIor( vec3 fresnel0 ) {
		vec3 sqrtF0 = sqrt( fresnel0 );
		return ( vec3( 1.0 ) + sqrtF0 ) / ( vec3( 1.0 ) - sqrtF0 );
	}
	vec3 IorToFresnel0( vec3 transmittedIor, float incidentIor ) {
		return pow2( ( transmittedIor - vec3( incidentIor ) ) / ( transmittedIor + vec3( incidentIor ) ) );
	}
	float IorToFresnel0( float transmittedIor, float incidentIor ) {
		return pow2( ( transmittedIor - incidentIor ) / ( transmittedIor + incidentIor ));
	}
	vec3 evalSensitivity( float OPD, vec3 shift ) {
		float phase = 2.0 * PI * OPD * 1.0e-9;
		vec3 val = vec3( 5.4856e-13, 4.4201e-13, 5.2481e-13 );
		vec3 pos = vec3( 1.6810e+06, 1.7953e+06, 2.2084e+06 );
		vec3 var = vec3( 4.3278e+09, 9.3046e+09, 6.6121e+09 );
		vec3 xyz = val * sqrt( 2.0 * PI * var ) * cos( pos * phase + shift ) * exp( - pow2( phase ) * var );
		xyz.x += 9.7470e-14 * sqrt( 2.0 * PI * 4.5282e+09 ) * cos( 2.2399e+06 * phase + shift[ 0 ] ) * exp( - 4.5282e+09 * pow2( phase ) );
		xyz /= 1.0685e-7;
		vec3 rgb = XYZ_TO_REC709 * xyz;
		return rgb;
	}
	vec3 evalIridescence( float outsideIOR, float eta2, float cosTheta1, float thinFilmThickness, vec3 baseF0 ) {
		vec3 I;
		float iridescenceIOR = mix( outsideIOR, eta2, smoothstep( 0.0, 0.03, thinFilmThickness ) );
		float sinTheta2Sq = pow2( outsideIOR / iridescenceIOR ) * ( 1.0 - pow2( cosTheta1 ) );
		float cosTheta2Sq = 1.0 - sinTheta2Sq;
		if ( cosTheta2Sq < 0.0 ) {
			return vec3( 1.0 );
		}
		float cosTheta2 = sqrt( cosTheta2Sq );
		float R0 = IorToFresnel0( iridescenceIOR, outsideIOR );
		float R12 = F_Schlick( R0, 1.0, cosTheta1 );
		float T121 = 1.0 - R12;
		float phi12 = 0.0;
		if ( iridescenceIOR < outsideIOR ) phi12 = PI;
		float phi21 = PI - phi12;
		vec3 baseIOR = Fresnel0ToIor( clamp( baseF0, 0.0, 0.9999 ) );		vec3 R1 = IorToFresnel0( baseIOR, iridescenceIOR );
		vec3 R23 = F_Schlick( R1, 1.0, cosTheta2 );
		vec3 phi23 = vec3( 0.0 );
		if ( baseIOR[ 0 ] < iridescenceIOR ) phi23[ 0 ] = PI;
		if ( baseIOR[ 1 ] < iridescenceIOR ) phi23[ 1 ] = PI;
		if ( baseIOR[ 2 ] < iridescenceIOR ) phi23[ 2 ] = PI;
		float OPD = 2.0 * iridescenceIOR * thinFilmThickness * cosTheta2;
		vec3 phi = vec3( phi21 ) + phi23;
		vec3 R123 = clamp( R12 * R23, 1e-5, 0.9999 );
		vec3 r123 = sqrt( R123 );
		vec3 Rs = pow2( T121 ) * R23 / ( vec3( 1.0 ) - R123 );
		vec3 C0 = R12 + Rs;
		I = C0;
		vec3 Cm = Rs - T121;
		for ( int m = 1; m <= 2; ++ m ) {
			Cm *= r123;
			vec3 Sm = 2.0 * evalSensitivity( float( m ) * OPD, float( m ) * phi );
			I += Cm * Sm;
		}
		return max( I, vec3( 0.0 ) );
	}
#endif`,I_=`#ifdef USE_BUMPMAP
	uniform sampler2D bumpMap;
	uniform float bumpScale;
	vec2 dHdxy_fwd() {
		vec2 dSTdx = dFdx( vBumpMapUv );
		vec2 dSTdy = dFdy( vBumpMapUv );
		float Hll = bumpScale * texture2D( bumpMap, vBumpMapUv ).x;
		float dBx = bumpScale * texture2D( bumpMap, vBumpMapUv + dSTdx ).x - Hll;
		float dBy = bumpScale * texture2D( bumpMap, vBumpMapUv + dSTdy ).x - Hll;
		return vec2( dBx, dBy );
	}
	vec3 perturbNormalArb( vec3 surf_pos, vec3 surf_norm, vec2 dHdxy, float faceDirection ) {
		vec3 vSigmaX = normalize( dFdx( surf_pos.xyz ) );
		vec3 vSigmaY = normalize( dFdy( surf_pos.xyz ) );
		vec3 vN = surf_norm;
		vec3 R1 = cross( vSigmaY, vN );
		vec3 R2 = cross( vN, vSigmaX );
		float fDet = dot( vSigmaX, R1 ) * faceDirection;
		vec3 vGrad = sign( fDet ) * ( dHdxy.x * R1 + dHdxy.y * R2 );
		return normalize( abs( fDet ) * surf_norm - vGrad );
	}
#endif`,L_=`#if NUM_CLIPPING_PLANES > 0
	vec4 plane;
	#ifdef ALPHA_TO_COVERAGE
		float distanceToPlane, distanceGradient;
		float clipOpacity = 1.0;
		#pragma unroll_loop_start
		for ( int i = 0; i < UNION_CLIPPING_PLANES; i ++ ) {
			plane = clippingPlanes[ i ];
			distanceToPlane = - dot( vClipPosition, plane.xyz ) + plane.w;
			distanceGradient = fwidth( distanceToPlane ) / 2.0;
			clipOpacity *= smoothstep( - distanceGradient, distanceGradient, distanceToPlane );
			if ( clipOpacity == 0.0 ) discard;
		}
		#pragma unroll_loop_end
		#if UNION_CLIPPING_PLANES < NUM_CLIPPING_PLANES
			float unionClipOpacity = 1.0;
			#pragma unroll_loop_start
			for ( int i = UNION_CLIPPING_PLANES; i < NUM_CLIPPING_PLANES; i ++ ) {
				plane = clippingPlanes[ i ];
				distanceToPlane = - dot( vClipPosition, plane.xyz ) + plane.w;
				distanceGradient = fwidth( distanceToPlane ) / 2.0;
				unionClipOpacity *= 1.0 - smoothstep( - distanceGradient, distanceGradient, distanceToPlane );
			}
			#pragma unroll_loop_end
			clipOpacity *= 1.0 - unionClipOpacity;
		#endif
		diffuseColor.a *= clipOpacity;
		if ( diffuseColor.a == 0.0 ) discard;
	#else
		#pragma unroll_loop_start
		for ( int i = 0; i < UNION_CLIPPING_PLANES; i ++ ) {
			plane = clippingPlanes[ i ];
			if ( dot( vClipPosition, plane.xyz ) > plane.w ) discard;
		}
		#pragma unroll_loop_end
		#if UNION_CLIPPING_PLANES < NUM_CLIPPING_PLANES
			bool clipped = true;
			#pragma unroll_loop_start
			for ( int i = UNION_CLIPPING_PLANES; i < NUM_CLIPPING_PLANES; i ++ ) {
				plane = clippingPlanes[ i ];
				clipped = ( dot( vClipPosition, plane.xyz ) > plane.w ) && clipped;
			}
			#pragma unroll_loop_end
			if ( clipped ) discard;
		#endif
	#endif
#endif`,D_=`#if NUM_CLIPPING_PLANES > 0
	varying vec3 vClipPosition;
	uniform vec4 clippingPlanes[ NUM_CLIPPING_PLANES ];
#endif`,N_=`#if NUM_CLIPPING_PLANES > 0
	varying vec3 vClipPosition;
#endif`,F_=`#if NUM_CLIPPING_PLANES > 0
	vClipPosition = - mvPosition.xyz;
#endif`,U_=`#if defined( USE_COLOR ) || defined( USE_COLOR_ALPHA )
	diffuseColor *= vColor;
#endif`,O_=`#if defined( USE_COLOR ) || defined( USE_COLOR_ALPHA )
	varying vec4 vColor;
#endif`,B_=`#if defined( USE_COLOR ) || defined( USE_COLOR_ALPHA ) || defined( USE_INSTANCING_COLOR ) || defined( USE_BATCHING_COLOR )
	varying vec4 vColor;
#endif`,k_=`#if defined( USE_COLOR ) || defined( USE_COLOR_ALPHA ) || defined( USE_INSTANCING_COLOR ) || defined( USE_BATCHING_COLOR )
	vColor = vec4( 1.0 );
#endif
#ifdef USE_COLOR_ALPHA
	vColor *= color;
#elif defined( USE_COLOR )
	vColor.rgb *= color;
#endif
#ifdef USE_INSTANCING_COLOR
	vColor.rgb *= instanceColor.rgb;
#endif
#ifdef USE_BATCHING_COLOR
	vColor *= getBatchingColor( getIndirectIndex( gl_DrawID ) );
#endif`,z_=`#define PI 3.141592653589793
#define PI2 6.283185307179586
#define PI_HALF 1.5707963267948966
#define RECIPROCAL_PI 0.3183098861837907
#define RECIPROCAL_PI2 0.15915494309189535
#define EPSILON 1e-6
#ifndef saturate
#define saturate( a ) clamp( a, 0.0, 1.0 )
#endif
#define whiteComplement( a ) ( 1.0 - saturate( a ) )
float pow2( const in float x ) { return x*x; }
vec3 pow2( const in vec3 x ) { return x*x; }
float pow3( const in float x ) { return x*x*x; }
float pow4( const in float x ) { float x2 = x*x; return x2*x2; }
float max3( const in vec3 v ) { return max( max( v.x, v.y ), v.z ); }
float average( const in vec3 v ) { return dot( v, vec3( 0.3333333 ) ); }
highp float rand( const in vec2 uv ) {
	const highp float a = 12.9898, b = 78.233, c = 43758.5453;
	highp float dt = dot( uv.xy, vec2( a,b ) ), sn = mod( dt, PI );
	return fract( sin( sn ) * c );
}
#ifdef HIGH_PRECISION
	float precisionSafeLength( vec3 v ) { return length( v ); }
#else
	float precisionSafeLength( vec3 v ) {
		float maxComponent = max3( abs( v ) );
		return length( v / maxComponent ) * maxComponent;
	}
#endif
struct IncidentLight {
	vec3 color;
	vec3 direction;
	bool visible;
};
struct ReflectedLight {
	vec3 directDiffuse;
	vec3 directSpecular;
	vec3 indirectDiffuse;
	vec3 indirectSpecular;
};
#ifdef USE_ALPHAHASH
	varying vec3 vPosition;
#endif
vec3 transformDirection( in vec3 dir, in mat4 matrix ) {
	return normalize( ( matrix * vec4( dir, 0.0 ) ).xyz );
}
#define inverseTransformDirection transformDirectionByInverseViewMatrix
vec3 transformNormalByInverseViewMatrix( in vec3 normal, in mat4 viewMatrix ) {
	return normalize( ( vec4( normal, 0.0 ) * viewMatrix ).xyz );
}
vec3 transformDirectionByInverseViewMatrix( in vec3 dir, in mat4 viewMatrix ) {
	return normalize( ( vec4( dir, 0.0 ) * viewMatrix ).xyz );
}
bool isPerspectiveMatrix( mat4 m ) {
	return m[ 2 ][ 3 ] == - 1.0;
}
vec2 equirectUv( in vec3 dir ) {
	float u = atan( dir.z, dir.x ) * RECIPROCAL_PI2 + 0.5;
	float v = asin( clamp( dir.y, - 1.0, 1.0 ) ) * RECIPROCAL_PI + 0.5;
	return vec2( u, v );
}
vec3 BRDF_Lambert( const in vec3 diffuseColor ) {
	return RECIPROCAL_PI * diffuseColor;
}
vec3 F_Schlick( const in vec3 f0, const in float f90, const in float dotVH ) {
	float fresnel = exp2( ( - 5.55473 * dotVH - 6.98316 ) * dotVH );
	return f0 * ( 1.0 - fresnel ) + ( f90 * fresnel );
}
float F_Schlick( const in float f0, const in float f90, const in float dotVH ) {
	float fresnel = exp2( ( - 5.55473 * dotVH - 6.98316 ) * dotVH );
	return f0 * ( 1.0 - fresnel ) + ( f90 * fresnel );
} // validated`,H_=`vec3 transformedNormal = objectNormal;
#ifdef USE_TANGENT
	vec3 transformedTangent = objectTangent;
#endif
#ifdef USE_BATCHING
	mat3 bm = mat3( batchingMatrix );
	transformedNormal /= vec3( dot( bm[ 0 ], bm[ 0 ] ), dot( bm[ 1 ], bm[ 1 ] ), dot( bm[ 2 ], bm[ 2 ] ) );
	transformedNormal = bm * transformedNormal;
	#ifdef USE_TANGENT
		transformedTangent = bm * transformedTangent;
	#endif
#endif
#ifdef USE_INSTANCING
	mat3 im = mat3( instanceMatrix );
	transformedNormal /= vec3( dot( im[ 0 ], im[ 0 ] ), dot( im[ 1 ], im[ 1 ] ), dot( im[ 2 ], im[ 2 ] ) );
	transformedNormal = im * transformedNormal;
	#ifdef USE_TANGENT
		transformedTangent = im * transformedTangent;
	#endif
#endif
transformedNormal = normalMatrix * transformedNormal;
#ifdef FLIP_SIDED
	transformedNormal = - transformedNormal;
#endif
#ifdef USE_TANGENT
	transformedTangent = ( modelViewMatrix * vec4( transformedTangent, 0.0 ) ).xyz;
#endif`,V_=`#ifdef USE_DISPLACEMENTMAP
	uniform sampler2D displacementMap;
	uniform float displacementScale;
	uniform float displacementBias;
#endif`,G_=`#ifdef USE_DISPLACEMENTMAP
	transformed += normalize( objectNormal ) * ( texture2D( displacementMap, vDisplacementMapUv ).x * displacementScale + displacementBias );
#endif`,W_=`#ifdef USE_EMISSIVEMAP
	vec4 emissiveColor = texture2D( emissiveMap, vEmissiveMapUv );
	#ifdef DECODE_VIDEO_TEXTURE_EMISSIVE
		emissiveColor = sRGBTransferEOTF( emissiveColor );
	#endif
	totalEmissiveRadiance *= emissiveColor.rgb;
#endif`,X_=`#ifdef USE_EMISSIVEMAP
	uniform sampler2D emissiveMap;
#endif`,q_="gl_FragColor = linearToOutputTexel( gl_FragColor );",Y_=`vec4 LinearTransferOETF( in vec4 value ) {
	return value;
}
vec4 sRGBTransferEOTF( in vec4 value ) {
	return vec4( mix( pow( value.rgb * 0.9478672986 + vec3( 0.0521327014 ), vec3( 2.4 ) ), value.rgb * 0.0773993808, vec3( lessThanEqual( value.rgb, vec3( 0.04045 ) ) ) ), value.a );
}
vec4 sRGBTransferOETF( in vec4 value ) {
	return vec4( mix( pow( value.rgb, vec3( 0.41666 ) ) * 1.055 - vec3( 0.055 ), value.rgb * 12.92, vec3( lessThanEqual( value.rgb, vec3( 0.0031308 ) ) ) ), value.a );
}`,$_=`#ifdef USE_ENVMAP
	#ifdef ENV_WORLDPOS
		vec3 cameraToFrag;
		if ( isOrthographic ) {
			cameraToFrag = normalize( vec3( - viewMatrix[ 0 ][ 2 ], - viewMatrix[ 1 ][ 2 ], - viewMatrix[ 2 ][ 2 ] ) );
		} else {
			cameraToFrag = normalize( vWorldPosition - cameraPosition );
		}
		vec3 worldNormal = transformNormalByInverseViewMatrix( normal, viewMatrix );
		#ifdef ENVMAP_MODE_REFLECTION
			vec3 reflectVec = reflect( cameraToFrag, worldNormal );
		#else
			vec3 reflectVec = refract( cameraToFrag, worldNormal, refractionRatio );
		#endif
	#else
		vec3 reflectVec = vReflect;
	#endif
	#ifdef ENVMAP_TYPE_CUBE
		vec4 envColor = textureCube( envMap, envMapRotation * reflectVec );
		#ifdef ENVMAP_BLENDING_MULTIPLY
			outgoingLight = mix( outgoingLight, outgoingLight * envColor.xyz, specularStrength * reflectivity );
		#elif defined( ENVMAP_BLENDING_MIX )
			outgoingLight = mix( outgoingLight, envColor.xyz, specularStrength * reflectivity );
		#elif defined( ENVMAP_BLENDING_ADD )
			outgoingLight += envColor.xyz * specularStrength * reflectivity;
		#endif
	#endif
#endif`,Z_=`#ifdef USE_ENVMAP
	uniform float envMapIntensity;
	uniform mat3 envMapRotation;
	uniform samplerCube envMap;
	#ifdef ENVMAP_TYPE_PMREM
		float roughnessToMip( const in float roughness ) {
			float r = clamp( roughness, 0.0, 1.0 );
			return ENVMAP_MAX_LOD * r * ( 2.0 - r );
		}
	#endif
#endif`,K_=`#ifdef USE_ENVMAP
	uniform float reflectivity;
	#if defined( USE_BUMPMAP ) || defined( USE_NORMALMAP ) || defined( PHONG ) || defined( LAMBERT )
		#define ENV_WORLDPOS
	#endif
	#ifdef ENV_WORLDPOS
		varying vec3 vWorldPosition;
		uniform float refractionRatio;
	#else
		varying vec3 vReflect;
	#endif
#endif`,J_=`#ifdef USE_ENVMAP
	#if defined( USE_BUMPMAP ) || defined( USE_NORMALMAP ) || defined( PHONG ) || defined( LAMBERT )
		#define ENV_WORLDPOS
	#endif
	#ifdef ENV_WORLDPOS
		
		varying vec3 vWorldPosition;
	#else
		varying vec3 vReflect;
		uniform float refractionRatio;
	#endif
#endif`,j_=`#ifdef USE_ENVMAP
	#ifdef ENV_WORLDPOS
		vWorldPosition = worldPosition.xyz;
	#else
		vec3 cameraToVertex;
		if ( isOrthographic ) {
			cameraToVertex = normalize( vec3( - viewMatrix[ 0 ][ 2 ], - viewMatrix[ 1 ][ 2 ], - viewMatrix[ 2 ][ 2 ] ) );
		} else {
			cameraToVertex = normalize( worldPosition.xyz - cameraPosition );
		}
		vec3 worldNormal = transformNormalByInverseViewMatrix( transformedNormal, viewMatrix );
		#ifdef ENVMAP_MODE_REFLECTION
			vReflect = reflect( cameraToVertex, worldNormal );
		#else
			vReflect = refract( cameraToVertex, worldNormal, refractionRatio );
		#endif
	#endif
#endif`,Q_=`#ifdef USE_FOG
	vFogDepth = - mvPosition.z;
#endif`,ex=`#ifdef USE_FOG
	varying float vFogDepth;
#endif`,tx=`#ifdef USE_FOG
	#ifdef FOG_EXP2
		float fogFactor = 1.0 - exp( - fogDensity * fogDensity * vFogDepth * vFogDepth );
	#else
		float fogFactor = smoothstep( fogNear, fogFar, vFogDepth );
	#endif
	gl_FragColor.rgb = mix( gl_FragColor.rgb, fogColor, fogFactor );
#endif`,nx=`#ifdef USE_FOG
	uniform vec3 fogColor;
	varying float vFogDepth;
	#ifdef FOG_EXP2
		uniform float fogDensity;
	#else
		uniform float fogNear;
		uniform float fogFar;
	#endif
#endif`,ix=`#ifdef USE_GRADIENTMAP
	uniform sampler2D gradientMap;
#endif
vec3 getGradientIrradiance( vec3 normal, vec3 lightDirection ) {
	float dotNL = dot( normal, lightDirection );
	vec2 coord = vec2( dotNL * 0.5 + 0.5, 0.0 );
	#ifdef USE_GRADIENTMAP
		return vec3( texture2D( gradientMap, coord ).r );
	#else
		vec2 fw = fwidth( coord ) * 0.5;
		return mix( vec3( 0.7 ), vec3( 1.0 ), smoothstep( 0.7 - fw.x, 0.7 + fw.x, coord.x ) );
	#endif
}`,sx=`#ifdef USE_LIGHTMAP
	uniform sampler2D lightMap;
	uniform float lightMapIntensity;
#endif`,rx=`LambertMaterial material;
material.diffuseColor = diffuseColor.rgb;
material.specularStrength = specularStrength;`,ox=`varying vec3 vViewPosition;
struct LambertMaterial {
	vec3 diffuseColor;
	float specularStrength;
};
void RE_Direct_Lambert( const in IncidentLight directLight, const in vec3 geometryPosition, const in vec3 geometryNormal, const in vec3 geometryViewDir, const in vec3 geometryClearcoatNormal, const in LambertMaterial material, inout ReflectedLight reflectedLight ) {
	float dotNL = saturate( dot( geometryNormal, directLight.direction ) );
	vec3 irradiance = dotNL * directLight.color;
	reflectedLight.directDiffuse += irradiance * BRDF_Lambert( material.diffuseColor );
}
void RE_IndirectDiffuse_Lambert( const in vec3 irradiance, const in vec3 geometryPosition, const in vec3 geometryNormal, const in vec3 geometryViewDir, const in vec3 geometryClearcoatNormal, const in LambertMaterial material, inout ReflectedLight reflectedLight ) {
	reflectedLight.indirectDiffuse += irradiance * BRDF_Lambert( material.diffuseColor );
}
#define RE_Direct				RE_Direct_Lambert
#define RE_IndirectDiffuse		RE_IndirectDiffuse_Lambert`,ax=`uniform bool receiveShadow;
uniform vec3 ambientLightColor;
#if defined( USE_LIGHT_PROBES )
	uniform vec3 lightProbe[ 9 ];
#endif
vec3 shGetIrradianceAt( in vec3 normal, in vec3 shCoefficients[ 9 ] ) {
	float x = normal.x, y = normal.y, z = normal.z;
	vec3 result = shCoefficients[ 0 ] * 0.886227;
	result += shCoefficients[ 1 ] * 2.0 * 0.511664 * y;
	result += shCoefficients[ 2 ] * 2.0 * 0.511664 * z;
	result += shCoefficients[ 3 ] * 2.0 * 0.511664 * x;
	result += shCoefficients[ 4 ] * 2.0 * 0.429043 * x * y;
	result += shCoefficients[ 5 ] * 2.0 * 0.429043 * y * z;
	result += shCoefficients[ 6 ] * ( 0.743125 * z * z - 0.247708 );
	result += shCoefficients[ 7 ] * 2.0 * 0.429043 * x * z;
	result += shCoefficients[ 8 ] * 0.429043 * ( x * x - y * y );
	return result;
}
vec3 getLightProbeIrradiance( const in vec3 lightProbe[ 9 ], const in vec3 normal ) {
	vec3 worldNormal = transformNormalByInverseViewMatrix( normal, viewMatrix );
	vec3 irradiance = shGetIrradianceAt( worldNormal, lightProbe );
	return irradiance;
}
vec3 getAmbientLightIrradiance( const in vec3 ambientLightColor ) {
	vec3 irradiance = ambientLightColor;
	return irradiance;
}
float getDistanceAttenuation( const in float lightDistance, const in float cutoffDistance, const in float decayExponent ) {
	float distanceFalloff = 1.0 / max( pow( lightDistance, decayExponent ), 0.01 );
	if ( cutoffDistance > 0.0 ) {
		distanceFalloff *= pow2( saturate( 1.0 - pow4( lightDistance / cutoffDistance ) ) );
	}
	return distanceFalloff;
}
float getSpotAttenuation( const in float coneCosine, const in float penumbraCosine, const in float angleCosine ) {
	return smoothstep( coneCosine, penumbraCosine, angleCosine );
}
#if NUM_SUN_LIGHTS > 0
	struct SunLight {
		vec3 direction;
		vec3 color;
	};
	uniform SunLight sunLights[ NUM_SUN_LIGHTS ];
	void getSunLightInfo( const in SunLight sunLight, out IncidentLight light ) {
		light.color = sunLight.color;
		light.direction = sunLight.direction;
		light.visible = true;
	}
#endif
#if NUM_DIR_LIGHTS > 0
	struct DirectionalLight {
		vec3 direction;
		vec3 color;
	};
	uniform DirectionalLight directionalLights[ NUM_DIR_LIGHTS ];
	void getDirectionalLightInfo( const in DirectionalLight directionalLight, out IncidentLight light ) {
		light.color = directionalLight.color;
		light.direction = directionalLight.direction;
		light.visible = true;
	}
#endif
#if NUM_POINT_LIGHTS > 0
	struct PointLight {
		vec3 position;
		vec3 color;
		float distance;
		float decay;
	};
	uniform PointLight pointLights[ NUM_POINT_LIGHTS ];
	void getPointLightInfo( const in PointLight pointLight, const in vec3 geometryPosition, out IncidentLight light ) {
		vec3 lVector = pointLight.position - geometryPosition;
		light.direction = normalize( lVector );
		float lightDistance = length( lVector );
		light.color = pointLight.color;
		light.color *= getDistanceAttenuation( lightDistance, pointLight.distance, pointLight.decay );
		light.visible = ( light.color != vec3( 0.0 ) );
	}
#endif
#if NUM_SPOT_LIGHTS > 0
	struct SpotLight {
		vec3 position;
		vec3 direction;
		vec3 color;
		float distance;
		float decay;
		float coneCos;
		float penumbraCos;
	};
	uniform SpotLight spotLights[ NUM_SPOT_LIGHTS ];
	void getSpotLightInfo( const in SpotLight spotLight, const in vec3 geometryPosition, out IncidentLight light ) {
		vec3 lVector = spotLight.position - geometryPosition;
		light.direction = normalize( lVector );
		float angleCos = dot( light.direction, spotLight.direction );
		float spotAttenuation = getSpotAttenuation( spotLight.coneCos, spotLight.penumbraCos, angleCos );
		if ( spotAttenuation > 0.0 ) {
			float lightDistance = length( lVector );
			light.color = spotLight.color * spotAttenuation;
			light.color *= getDistanceAttenuation( lightDistance, spotLight.distance, spotLight.decay );
			light.visible = ( light.color != vec3( 0.0 ) );
		} else {
			light.color = vec3( 0.0 );
			light.visible = false;
		}
	}
#endif
#if NUM_RECT_AREA_LIGHTS > 0
	struct RectAreaLight {
		vec3 color;
		vec3 position;
		vec3 halfWidth;
		vec3 halfHeight;
	};
	uniform sampler2D ltc_1;	uniform sampler2D ltc_2;
	uniform RectAreaLight rectAreaLights[ NUM_RECT_AREA_LIGHTS ];
#endif
#if NUM_HEMI_LIGHTS > 0
	struct HemisphereLight {
		vec3 direction;
		vec3 skyColor;
		vec3 groundColor;
	};
	uniform HemisphereLight hemisphereLights[ NUM_HEMI_LIGHTS ];
	vec3 getHemisphereLightIrradiance( const in HemisphereLight hemiLight, const in vec3 normal ) {
		float dotNL = dot( normal, hemiLight.direction );
		float hemiDiffuseWeight = 0.5 * dotNL + 0.5;
		vec3 irradiance = mix( hemiLight.groundColor, hemiLight.skyColor, hemiDiffuseWeight );
		return irradiance;
	}
#endif
#include <lightprobes_pars_fragment>`,lx=`#ifdef USE_ENVMAP
	vec3 getIBLIrradiance( const in vec3 normal ) {
		#ifdef ENVMAP_TYPE_PMREM
			vec3 worldNormal = transformNormalByInverseViewMatrix( normal, viewMatrix );
			vec4 envMapColor = textureLod( envMap, envMapRotation * worldNormal, ENVMAP_MAX_LOD );
			return PI * envMapColor.rgb * envMapIntensity;
		#else
			return vec3( 0.0 );
		#endif
	}
	vec3 getIBLRadiance( const in vec3 viewDir, const in vec3 normal, const in float roughness ) {
		#ifdef ENVMAP_TYPE_PMREM
			vec3 reflectVec = reflect( - viewDir, normal );
			reflectVec = normalize( mix( reflectVec, normal, pow4( roughness ) ) );
			reflectVec = transformDirectionByInverseViewMatrix( reflectVec, viewMatrix );
			vec4 envMapColor = textureLod( envMap, envMapRotation * reflectVec, roughnessToMip( roughness ) );
			return envMapColor.rgb * envMapIntensity;
		#else
			return vec3( 0.0 );
		#endif
	}
	#ifdef USE_RETROREFLECTION
		vec3 getIBLRetroRadiance( const in vec3 viewDir, const in vec3 normal, const in float roughness ) {
			#ifdef ENVMAP_TYPE_PMREM
				vec3 retroVec = normalize( mix( viewDir, normal, pow4( roughness ) ) );
				retroVec = transformDirectionByInverseViewMatrix( retroVec, viewMatrix );
				vec4 envMapColor = textureLod( envMap, envMapRotation * retroVec, roughnessToMip( roughness ) );
				return envMapColor.rgb * envMapIntensity;
			#else
				return vec3( 0.0 );
			#endif
		}
	#endif
	#ifdef USE_ANISOTROPY
		vec3 getIBLAnisotropyRadiance( const in vec3 viewDir, const in vec3 normal, const in float roughness, const in vec3 bitangent, const in float anisotropy ) {
			#ifdef ENVMAP_TYPE_PMREM
				vec3 bentNormal = cross( bitangent, viewDir );
				bentNormal = normalize( cross( bentNormal, bitangent ) );
				bentNormal = normalize( mix( bentNormal, normal, pow2( pow2( 1.0 - anisotropy * ( 1.0 - roughness ) ) ) ) );
				return getIBLRadiance( viewDir, bentNormal, roughness );
			#else
				return vec3( 0.0 );
			#endif
		}
		#ifdef USE_RETROREFLECTION
			vec3 getIBLAnisotropyRetroRadiance( const in vec3 viewDir, const in vec3 normal, const in float roughness, const in vec3 bitangent, const in float anisotropy ) {
				#ifdef ENVMAP_TYPE_PMREM
					vec3 bentNormal = cross( bitangent, viewDir );
					bentNormal = normalize( cross( bentNormal, bitangent ) );
					bentNormal = normalize( mix( bentNormal, normal, pow2( pow2( 1.0 - anisotropy * ( 1.0 - roughness ) ) ) ) );
					return getIBLRetroRadiance( viewDir, bentNormal, roughness );
				#else
					return vec3( 0.0 );
				#endif
			}
		#endif
	#endif
#endif`,cx=`ToonMaterial material;
material.diffuseColor = diffuseColor.rgb;`,hx=`varying vec3 vViewPosition;
struct ToonMaterial {
	vec3 diffuseColor;
};
void RE_Direct_Toon( const in IncidentLight directLight, const in vec3 geometryPosition, const in vec3 geometryNormal, const in vec3 geometryViewDir, const in vec3 geometryClearcoatNormal, const in ToonMaterial material, inout ReflectedLight reflectedLight ) {
	vec3 irradiance = getGradientIrradiance( geometryNormal, directLight.direction ) * directLight.color;
	reflectedLight.directDiffuse += irradiance * BRDF_Lambert( material.diffuseColor );
}
void RE_IndirectDiffuse_Toon( const in vec3 irradiance, const in vec3 geometryPosition, const in vec3 geometryNormal, const in vec3 geometryViewDir, const in vec3 geometryClearcoatNormal, const in ToonMaterial material, inout ReflectedLight reflectedLight ) {
	reflectedLight.indirectDiffuse += irradiance * BRDF_Lambert( material.diffuseColor );
}
#define RE_Direct				RE_Direct_Toon
#define RE_IndirectDiffuse		RE_IndirectDiffuse_Toon`,ux=`BlinnPhongMaterial material;
material.diffuseColor = diffuseColor.rgb;
material.specularColor = specular;
material.specularShininess = shininess;
material.specularStrength = specularStrength;`,dx=`varying vec3 vViewPosition;
struct BlinnPhongMaterial {
	vec3 diffuseColor;
	vec3 specularColor;
	float specularShininess;
	float specularStrength;
};
void RE_Direct_BlinnPhong( const in IncidentLight directLight, const in vec3 geometryPosition, const in vec3 geometryNormal, const in vec3 geometryViewDir, const in vec3 geometryClearcoatNormal, const in BlinnPhongMaterial material, inout ReflectedLight reflectedLight ) {
	float dotNL = saturate( dot( geometryNormal, directLight.direction ) );
	vec3 irradiance = dotNL * directLight.color;
	reflectedLight.directDiffuse += irradiance * BRDF_Lambert( material.diffuseColor );
	reflectedLight.directSpecular += irradiance * BRDF_BlinnPhong( directLight.direction, geometryViewDir, geometryNormal, material.specularColor, material.specularShininess ) * material.specularStrength;
}
void RE_IndirectDiffuse_BlinnPhong( const in vec3 irradiance, const in vec3 geometryPosition, const in vec3 geometryNormal, const in vec3 geometryViewDir, const in vec3 geometryClearcoatNormal, const in BlinnPhongMaterial material, inout ReflectedLight reflectedLight ) {
	reflectedLight.indirectDiffuse += irradiance * BRDF_Lambert( material.diffuseColor );
}
#define RE_Direct				RE_Direct_BlinnPhong
#define RE_IndirectDiffuse		RE_IndirectDiffuse_BlinnPhong`,fx=`PhysicalMaterial material;
material.diffuseColor = diffuseColor.rgb;
material.diffuseContribution = diffuseColor.rgb * ( 1.0 - metalnessFactor );
material.metalness = metalnessFactor;
vec3 dxy = max( abs( dFdx( nonPerturbedNormal ) ), abs( dFdy( nonPerturbedNormal ) ) );
float geometryRoughness = max( max( dxy.x, dxy.y ), dxy.z );
material.roughness = max( roughnessFactor, 0.045 );
material.roughness += geometryRoughness;
material.roughness = min( material.roughness, 1.0 );
#ifdef USE_DIFFUSE_ROUGHNESS
	float diffuseRoughnessFactor = diffuseRoughness;
	#ifdef USE_DIFFUSE_ROUGHNESSMAP
		diffuseRoughnessFactor *= texture2D( diffuseRoughnessMap, vDiffuseRoughnessMapUv ).r;
	#endif
	material.diffuseRoughness = saturate( diffuseRoughnessFactor );
#endif
#ifdef IOR
	material.ior = ior;
	#ifdef USE_SPECULAR
		float specularIntensityFactor = specularIntensity;
		vec3 specularColorFactor = specularColor;
		#ifdef USE_SPECULAR_COLORMAP
			specularColorFactor *= texture2D( specularColorMap, vSpecularColorMapUv ).rgb;
		#endif
		#ifdef USE_SPECULAR_INTENSITYMAP
			specularIntensityFactor *= texture2D( specularIntensityMap, vSpecularIntensityMapUv ).a;
		#endif
		material.specularF90 = mix( specularIntensityFactor, 1.0, metalnessFactor );
	#else
		float specularIntensityFactor = 1.0;
		vec3 specularColorFactor = vec3( 1.0 );
		material.specularF90 = 1.0;
	#endif
	material.specularColor = min( pow2( ( material.ior - 1.0 ) / ( material.ior + 1.0 ) ) * specularColorFactor, vec3( 1.0 ) ) * specularIntensityFactor;
	material.specularColorBlended = mix( material.specularColor, diffuseColor.rgb, metalnessFactor );
#else
	material.specularColor = vec3( 0.04 );
	material.specularColorBlended = mix( material.specularColor, diffuseColor.rgb, metalnessFactor );
	material.specularF90 = 1.0;
#endif
#ifdef USE_CLEARCOAT
	material.clearcoat = clearcoat;
	material.clearcoatRoughness = clearcoatRoughness;
	material.clearcoatF0 = vec3( 0.04 );
	material.clearcoatF90 = 1.0;
	#ifdef USE_CLEARCOATMAP
		material.clearcoat *= texture2D( clearcoatMap, vClearcoatMapUv ).x;
	#endif
	#ifdef USE_CLEARCOAT_ROUGHNESSMAP
		material.clearcoatRoughness *= texture2D( clearcoatRoughnessMap, vClearcoatRoughnessMapUv ).y;
	#endif
	material.clearcoat = saturate( material.clearcoat );	material.clearcoatRoughness = max( material.clearcoatRoughness, 0.045 );
	material.clearcoatRoughness += geometryRoughness;
	material.clearcoatRoughness = min( material.clearcoatRoughness, 1.0 );
#endif
#ifdef USE_DISPERSION
	material.dispersion = dispersion;
#endif
#ifdef USE_RETROREFLECTION
	material.retroreflectivity = retroreflectivity;
#endif
#ifdef USE_IRIDESCENCE
	material.iridescence = iridescence;
	material.iridescenceIOR = iridescenceIOR;
	#ifdef USE_IRIDESCENCEMAP
		material.iridescence *= texture2D( iridescenceMap, vIridescenceMapUv ).r;
	#endif
	#ifdef USE_IRIDESCENCE_THICKNESSMAP
		material.iridescenceThickness = (iridescenceThicknessMaximum - iridescenceThicknessMinimum) * texture2D( iridescenceThicknessMap, vIridescenceThicknessMapUv ).g + iridescenceThicknessMinimum;
	#else
		material.iridescenceThickness = iridescenceThicknessMaximum;
	#endif
#endif
#ifdef USE_SHEEN
	material.sheenColor = sheenColor;
	#ifdef USE_SHEEN_COLORMAP
		material.sheenColor *= texture2D( sheenColorMap, vSheenColorMapUv ).rgb;
	#endif
	material.sheenRoughness = clamp( sheenRoughness, 0.0001, 1.0 );
	#ifdef USE_SHEEN_ROUGHNESSMAP
		material.sheenRoughness *= texture2D( sheenRoughnessMap, vSheenRoughnessMapUv ).a;
	#endif
#endif
#ifdef USE_ANISOTROPY
	#ifdef USE_ANISOTROPYMAP
		mat2 anisotropyMat = mat2( anisotropyVector.x, anisotropyVector.y, - anisotropyVector.y, anisotropyVector.x );
		vec3 anisotropyPolar = texture2D( anisotropyMap, vAnisotropyMapUv ).rgb;
		vec2 anisotropyV = anisotropyMat * normalize( 2.0 * anisotropyPolar.rg - vec2( 1.0 ) ) * anisotropyPolar.b;
	#else
		vec2 anisotropyV = anisotropyVector;
	#endif
	material.anisotropy = length( anisotropyV );
	if( material.anisotropy == 0.0 ) {
		anisotropyV = vec2( 1.0, 0.0 );
	} else {
		anisotropyV /= material.anisotropy;
		material.anisotropy = saturate( material.anisotropy );
	}
	material.alphaT = mix( pow2( material.roughness ), 1.0, pow2( material.anisotropy ) );
	material.anisotropyT = tbn[ 0 ] * anisotropyV.x + tbn[ 1 ] * anisotropyV.y;
	material.anisotropyB = tbn[ 1 ] * anisotropyV.x - tbn[ 0 ] * anisotropyV.y;
#endif`,px=`uniform sampler2D dfgLUT;
struct PhysicalMaterial {
	vec3 diffuseColor;
	vec3 diffuseContribution;
	vec3 specularColor;
	vec3 specularColorBlended;
	float roughness;
	float metalness;
	float specularF90;
	float dispersion;
	vec2 dfg;
	vec3 multiScatteringCompensation;
	#ifdef USE_DIFFUSE_ROUGHNESS
		float diffuseRoughness;
	#endif
	#ifdef USE_RETROREFLECTION
		float retroreflectivity;
	#endif
	#ifdef USE_CLEARCOAT
		float clearcoat;
		float clearcoatRoughness;
		vec3 clearcoatF0;
		float clearcoatF90;
	#endif
	#ifdef USE_IRIDESCENCE
		float iridescence;
		float iridescenceIOR;
		float iridescenceThickness;
		vec3 iridescenceFresnel;
		vec3 iridescenceF0Dielectric;
		vec3 iridescenceF0Metallic;
	#endif
	#ifdef USE_SHEEN
		vec3 sheenColor;
		float sheenRoughness;
	#endif
	#ifdef IOR
		float ior;
	#endif
	#ifdef USE_TRANSMISSION
		float transmission;
		float transmissionAlpha;
		float thickness;
		float attenuationDistance;
		vec3 attenuationColor;
	#endif
	#ifdef USE_ANISOTROPY
		float anisotropy;
		float alphaT;
		vec3 anisotropyT;
		vec3 anisotropyB;
	#endif
};
vec3 clearcoatSpecularDirect = vec3( 0.0 );
vec3 clearcoatSpecularIndirect = vec3( 0.0 );
vec3 sheenSpecularDirect = vec3( 0.0 );
vec3 sheenSpecularIndirect = vec3(0.0 );
vec3 Schlick_to_F0( const in vec3 f, const in float f90, const in float dotVH ) {
    float x = clamp( 1.0 - dotVH, 0.0, 1.0 );
    float x2 = x * x;
    float x5 = clamp( x * x2 * x2, 0.0, 0.9999 );
    return ( f - vec3( f90 ) * x5 ) / ( 1.0 - x5 );
}
#ifdef USE_DIFFUSE_ROUGHNESS
	const float EON_EPSILON = 1e-7;
	float FON_DirectionalAlbedo( const in float mu, const in float roughness, const in float A ) {
		float muComp = 1.0 - mu;
		float gOverPi = muComp * ( 0.0571085289 + muComp * ( 0.491881867 + muComp * ( - 0.332181442 + muComp * 0.0714429953 ) ) );
		return A * ( 1.0 + roughness * gOverPi );
	}
	vec3 BRDF_EON( const in vec3 lightDir, const in vec3 viewDir, const in vec3 normal, const in vec3 diffuseColor, const in float roughness ) {
		vec3 rho = saturate( diffuseColor );
		if ( roughness <= EON_EPSILON ) return BRDF_Lambert( rho );
		float dotNL = saturate( dot( normal, lightDir ) );
		float dotNV = saturate( dot( normal, viewDir ) );
		float s = dot( lightDir, viewDir ) - dotNL * dotNV;
		float sOverT = ( s > 0.0 ) ? s / max( max( dotNL, dotNV ), EON_EPSILON ) : s;
		float A = 1.0 / ( 1.0 + ( 0.5 - 2.0 / ( 3.0 * PI ) ) * roughness );
		vec3 singleScatter = rho * RECIPROCAL_PI * A * ( 1.0 + roughness * sOverT );
		float averageAlbedo = A * ( 1.0 + ( 2.0 / 3.0 - 28.0 / ( 15.0 * PI ) ) * roughness );
		float albedoV = FON_DirectionalAlbedo( dotNV, roughness, A );
		float albedoL = FON_DirectionalAlbedo( dotNL, roughness, A );
		vec3 rhoMultiScatter = rho * rho * averageAlbedo / max( vec3( EON_EPSILON ), vec3( 1.0 ) - rho * ( 1.0 - averageAlbedo ) );
		vec3 multiScatter = rhoMultiScatter * RECIPROCAL_PI
			* max( EON_EPSILON, 1.0 - albedoV )
			* max( EON_EPSILON, 1.0 - albedoL )
			/ max( EON_EPSILON, 1.0 - averageAlbedo );
		return singleScatter + multiScatter;
	}
	vec3 EON_DirectionalAlbedo( const in vec3 diffuseColor, const in float roughness, const in float dotNV ) {
		vec3 rho = saturate( diffuseColor );
		if ( roughness <= EON_EPSILON ) return rho;
		float A = 1.0 / ( 1.0 + ( 0.5 - 2.0 / ( 3.0 * PI ) ) * roughness );
		float directionalAlbedo = FON_DirectionalAlbedo( dotNV, roughness, A );
		float averageAlbedo = A * ( 1.0 + ( 2.0 / 3.0 - 28.0 / ( 15.0 * PI ) ) * roughness );
		vec3 rhoMultiScatter = rho * rho * averageAlbedo / max( vec3( EON_EPSILON ), vec3( 1.0 ) - rho * ( 1.0 - averageAlbedo ) );
		return rho * directionalAlbedo + rhoMultiScatter * ( 1.0 - directionalAlbedo );
	}
#endif
float V_GGX_SmithCorrelated( const in float alpha, const in float dotNL, const in float dotNV ) {
	float a2 = pow2( alpha );
	float gv = dotNL * sqrt( a2 + ( 1.0 - a2 ) * pow2( dotNV ) );
	float gl = dotNV * sqrt( a2 + ( 1.0 - a2 ) * pow2( dotNL ) );
	return 0.5 / max( gv + gl, EPSILON );
}
float D_GGX( const in float alpha, const in float dotNH ) {
	float a2 = pow2( alpha );
	float denom = pow2( dotNH ) * ( a2 - 1.0 ) + 1.0;
	return RECIPROCAL_PI * a2 / pow2( denom );
}
#ifdef USE_ANISOTROPY
	float V_GGX_SmithCorrelated_Anisotropic( const in float alphaT, const in float alphaB, const in float dotTV, const in float dotBV, const in float dotTL, const in float dotBL, const in float dotNV, const in float dotNL ) {
		float gv = dotNL * length( vec3( alphaT * dotTV, alphaB * dotBV, dotNV ) );
		float gl = dotNV * length( vec3( alphaT * dotTL, alphaB * dotBL, dotNL ) );
		return 0.5 / max( gv + gl, EPSILON );
	}
	float D_GGX_Anisotropic( const in float alphaT, const in float alphaB, const in float dotNH, const in float dotTH, const in float dotBH ) {
		float a2 = alphaT * alphaB;
		highp vec3 v = vec3( alphaB * dotTH, alphaT * dotBH, a2 * dotNH );
		highp float v2 = dot( v, v );
		float w2 = a2 / v2;
		return RECIPROCAL_PI * a2 * pow2 ( w2 );
	}
#endif
#ifdef USE_CLEARCOAT
	vec3 BRDF_GGX_Clearcoat( const in vec3 lightDir, const in vec3 viewDir, const in vec3 normal, const in PhysicalMaterial material) {
		vec3 f0 = material.clearcoatF0;
		float f90 = material.clearcoatF90;
		float roughness = max( material.clearcoatRoughness, 0.045 );
		float alpha = pow2( roughness );
		vec3 halfDir = normalize( lightDir + viewDir );
		float dotNL = saturate( dot( normal, lightDir ) );
		float dotNV = saturate( dot( normal, viewDir ) );
		float dotNH = saturate( dot( normal, halfDir ) );
		float dotVH = saturate( dot( viewDir, halfDir ) );
		vec3 F = F_Schlick( f0, f90, dotVH );
		float V = V_GGX_SmithCorrelated( alpha, dotNL, dotNV );
		float D = D_GGX( alpha, dotNH );
		return F * ( V * D );
	}
#endif
vec3 BRDF_GGX( const in vec3 lightDir, const in vec3 viewDir, const in vec3 normal, const in PhysicalMaterial material ) {
	vec3 f0 = material.specularColorBlended;
	float f90 = material.specularF90;
	float roughness = max( material.roughness, 0.045 );
	float alpha = pow2( roughness );
	vec3 halfDir = normalize( lightDir + viewDir );
	float dotNL = saturate( dot( normal, lightDir ) );
	float dotNV = saturate( dot( normal, viewDir ) );
	float dotNH = saturate( dot( normal, halfDir ) );
	float dotVH = saturate( dot( viewDir, halfDir ) );
	vec3 F = F_Schlick( f0, f90, dotVH );
	#ifdef USE_IRIDESCENCE
		F = mix( F, material.iridescenceFresnel, material.iridescence );
	#endif
	#ifdef USE_ANISOTROPY
		float dotTL = dot( material.anisotropyT, lightDir );
		float dotTV = dot( material.anisotropyT, viewDir );
		float dotTH = dot( material.anisotropyT, halfDir );
		float dotBL = dot( material.anisotropyB, lightDir );
		float dotBV = dot( material.anisotropyB, viewDir );
		float dotBH = dot( material.anisotropyB, halfDir );
		float alphaT = max( material.alphaT, alpha );
		float V = V_GGX_SmithCorrelated_Anisotropic( alphaT, alpha, dotTV, dotBV, dotTL, dotBL, dotNV, dotNL );
		float D = D_GGX_Anisotropic( alphaT, alpha, dotNH, dotTH, dotBH );
	#else
		float V = V_GGX_SmithCorrelated( alpha, dotNL, dotNV );
		float D = D_GGX( alpha, dotNH );
	#endif
	return F * ( V * D );
}
vec2 LTC_Uv( const in vec3 N, const in vec3 V, const in float roughness ) {
	const float LUT_SIZE = 64.0;
	const float LUT_SCALE = ( LUT_SIZE - 1.0 ) / LUT_SIZE;
	const float LUT_BIAS = 0.5 / LUT_SIZE;
	float dotNV = saturate( dot( N, V ) );
	vec2 uv = vec2( roughness, sqrt( 1.0 - dotNV ) );
	uv = uv * LUT_SCALE + LUT_BIAS;
	return uv;
}
float LTC_ClippedSphereFormFactor( const in vec3 f ) {
	float l = length( f );
	return max( ( l * l + f.z ) / ( l + 1.0 ), 0.0 );
}
vec3 LTC_EdgeVectorFormFactor( const in vec3 v1, const in vec3 v2 ) {
	float x = dot( v1, v2 );
	float y = abs( x );
	float a = 0.8543985 + ( 0.4965155 + 0.0145206 * y ) * y;
	float b = 3.4175940 + ( 4.1616724 + y ) * y;
	float v = a / b;
	float theta_sintheta = ( x > 0.0 ) ? v : 0.5 * inversesqrt( max( 1.0 - x * x, 1e-7 ) ) - v;
	return cross( v1, v2 ) * theta_sintheta;
}
vec3 LTC_Evaluate( const in vec3 N, const in vec3 V, const in vec3 P, const in mat3 mInv, const in vec3 rectCoords[ 4 ] ) {
	vec3 v1 = rectCoords[ 1 ] - rectCoords[ 0 ];
	vec3 v2 = rectCoords[ 3 ] - rectCoords[ 0 ];
	vec3 lightNormal = cross( v1, v2 );
	if( dot( lightNormal, P - rectCoords[ 0 ] ) < 0.0 ) return vec3( 0.0 );
	vec3 T1, T2;
	T1 = normalize( V - N * dot( V, N ) );
	T2 = - cross( N, T1 );
	mat3 mat = mInv * transpose( mat3( T1, T2, N ) );
	vec3 coords[ 4 ];
	coords[ 0 ] = mat * ( rectCoords[ 0 ] - P );
	coords[ 1 ] = mat * ( rectCoords[ 1 ] - P );
	coords[ 2 ] = mat * ( rectCoords[ 2 ] - P );
	coords[ 3 ] = mat * ( rectCoords[ 3 ] - P );
	coords[ 0 ] = normalize( coords[ 0 ] );
	coords[ 1 ] = normalize( coords[ 1 ] );
	coords[ 2 ] = normalize( coords[ 2 ] );
	coords[ 3 ] = normalize( coords[ 3 ] );
	vec3 vectorFormFactor = vec3( 0.0 );
	vectorFormFactor += LTC_EdgeVectorFormFactor( coords[ 0 ], coords[ 1 ] );
	vectorFormFactor += LTC_EdgeVectorFormFactor( coords[ 1 ], coords[ 2 ] );
	vectorFormFactor += LTC_EdgeVectorFormFactor( coords[ 2 ], coords[ 3 ] );
	vectorFormFactor += LTC_EdgeVectorFormFactor( coords[ 3 ], coords[ 0 ] );
	float result = LTC_ClippedSphereFormFactor( vectorFormFactor );
	return vec3( result );
}
#if defined( USE_SHEEN )
float D_Charlie( float roughness, float dotNH ) {
	float alpha = pow2( roughness );
	float invAlpha = 1.0 / alpha;
	float cos2h = dotNH * dotNH;
	float sin2h = max( 1.0 - cos2h, 0.0078125 );
	return ( 2.0 + invAlpha ) * pow( sin2h, invAlpha * 0.5 ) / ( 2.0 * PI );
}
float V_Neubelt( float dotNV, float dotNL ) {
	return saturate( 1.0 / ( 4.0 * ( dotNL + dotNV - dotNL * dotNV ) ) );
}
vec3 BRDF_Sheen( const in vec3 lightDir, const in vec3 viewDir, const in vec3 normal, vec3 sheenColor, const in float sheenRoughness ) {
	vec3 halfDir = normalize( lightDir + viewDir );
	float dotNL = saturate( dot( normal, lightDir ) );
	float dotNV = saturate( dot( normal, viewDir ) );
	float dotNH = saturate( dot( normal, halfDir ) );
	float D = D_Charlie( sheenRoughness, dotNH );
	float V = V_Neubelt( dotNV, dotNL );
	return sheenColor * ( D * V );
}
#endif
float IBLSheenBRDF( const in vec3 normal, const in vec3 viewDir, const in float roughness ) {
	float dotNV = saturate( dot( normal, viewDir ) );
	float r2 = roughness * roughness;
	float rInv = 1.0 / ( roughness + 0.1 );
	float a = -1.9362 + 1.0678 * roughness + 0.4573 * r2 - 0.8469 * rInv;
	float b = -0.6014 + 0.5538 * roughness - 0.4670 * r2 - 0.1255 * rInv;
	float DG = exp( a * dotNV + b );
	return saturate( DG );
}
vec3 EnvironmentBRDF( const in vec3 normal, const in vec3 viewDir, const in vec3 specularColor, const in float specularF90, const in float roughness ) {
	float dotNV = saturate( dot( normal, viewDir ) );
	vec2 fab = texture2D( dfgLUT, vec2( roughness, dotNV ) ).rg;
	return specularColor * fab.x + specularF90 * fab.y;
}
#ifdef USE_IRIDESCENCE
void computeMultiscatteringIridescence( const in vec2 fab, const in vec3 specularColor, const in float specularF90, const in float iridescence, const in vec3 iridescenceF0, inout vec3 singleScatter, inout vec3 multiScatter ) {
#else
void computeMultiscattering( const in vec2 fab, const in vec3 specularColor, const in float specularF90, inout vec3 singleScatter, inout vec3 multiScatter ) {
#endif
	#ifdef USE_IRIDESCENCE
		vec3 Fr = mix( specularColor, iridescenceF0, iridescence );
	#else
		vec3 Fr = specularColor;
	#endif
	vec3 FssEss = Fr * fab.x + specularF90 * fab.y;
	float Ess = fab.x + fab.y;
	float Ems = 1.0 - Ess;
	vec3 Favg = Fr + ( 1.0 - Fr ) * 0.047619;	vec3 Fms = FssEss * Favg / ( 1.0 - Ems * Favg );
	singleScatter += FssEss;
	multiScatter += Fms * Ems;
}
#if NUM_RECT_AREA_LIGHTS > 0
	void RE_Direct_RectArea_Physical( const in RectAreaLight rectAreaLight, const in vec3 geometryPosition, const in vec3 geometryNormal, const in vec3 geometryViewDir, const in vec3 geometryClearcoatNormal, const in PhysicalMaterial material, inout ReflectedLight reflectedLight ) {
		vec3 normal = geometryNormal;
		vec3 viewDir = geometryViewDir;
		vec3 position = geometryPosition;
		vec3 lightPos = rectAreaLight.position;
		vec3 halfWidth = rectAreaLight.halfWidth;
		vec3 halfHeight = rectAreaLight.halfHeight;
		vec3 lightColor = rectAreaLight.color;
		float roughness = material.roughness;
		vec3 rectCoords[ 4 ];
		rectCoords[ 0 ] = lightPos + halfWidth - halfHeight;		rectCoords[ 1 ] = lightPos - halfWidth - halfHeight;
		rectCoords[ 2 ] = lightPos - halfWidth + halfHeight;
		rectCoords[ 3 ] = lightPos + halfWidth + halfHeight;
		vec2 uv = LTC_Uv( normal, viewDir, roughness );
		vec4 t1 = texture2D( ltc_1, uv );
		vec4 t2 = texture2D( ltc_2, uv );
		mat3 mInv = mat3(
			vec3( t1.x, 0, t1.y ),
			vec3(    0, 1,    0 ),
			vec3( t1.z, 0, t1.w )
		);
		vec3 fresnel = ( material.specularColorBlended * t2.x + ( material.specularF90 - material.specularColorBlended ) * t2.y );
		reflectedLight.directSpecular += lightColor * fresnel * LTC_Evaluate( normal, viewDir, position, mInv, rectCoords );
		reflectedLight.directDiffuse += lightColor * material.diffuseContribution * LTC_Evaluate( normal, viewDir, position, mat3( 1.0 ), rectCoords );
		#ifdef USE_CLEARCOAT
			vec3 Ncc = geometryClearcoatNormal;
			vec2 uvClearcoat = LTC_Uv( Ncc, viewDir, material.clearcoatRoughness );
			vec4 t1Clearcoat = texture2D( ltc_1, uvClearcoat );
			vec4 t2Clearcoat = texture2D( ltc_2, uvClearcoat );
			mat3 mInvClearcoat = mat3(
				vec3( t1Clearcoat.x, 0, t1Clearcoat.y ),
				vec3(             0, 1,             0 ),
				vec3( t1Clearcoat.z, 0, t1Clearcoat.w )
			);
			vec3 fresnelClearcoat = material.clearcoatF0 * t2Clearcoat.x + ( material.clearcoatF90 - material.clearcoatF0 ) * t2Clearcoat.y;
			clearcoatSpecularDirect += lightColor * fresnelClearcoat * LTC_Evaluate( Ncc, viewDir, position, mInvClearcoat, rectCoords );
		#endif
	}
#endif
void RE_Direct_Physical( const in IncidentLight directLight, const in vec3 geometryPosition, const in vec3 geometryNormal, const in vec3 geometryViewDir, const in vec3 geometryClearcoatNormal, const in PhysicalMaterial material, inout ReflectedLight reflectedLight ) {
	float dotNL = saturate( dot( geometryNormal, directLight.direction ) );
	vec3 irradiance = dotNL * directLight.color;
	#ifdef USE_CLEARCOAT
		float dotNLcc = saturate( dot( geometryClearcoatNormal, directLight.direction ) );
		vec3 ccIrradiance = dotNLcc * directLight.color;
		clearcoatSpecularDirect += ccIrradiance * BRDF_GGX_Clearcoat( directLight.direction, geometryViewDir, geometryClearcoatNormal, material );
	#endif
	#ifdef USE_SHEEN
 
 		sheenSpecularDirect += irradiance * BRDF_Sheen( directLight.direction, geometryViewDir, geometryNormal, material.sheenColor, material.sheenRoughness );
 
 		float sheenAlbedoV = IBLSheenBRDF( geometryNormal, geometryViewDir, material.sheenRoughness );
 		float sheenAlbedoL = IBLSheenBRDF( geometryNormal, directLight.direction, material.sheenRoughness );
 
 		float sheenEnergyComp = 1.0 - max3( material.sheenColor ) * max( sheenAlbedoV, sheenAlbedoL );
 
 		irradiance *= sheenEnergyComp;
 
 	#endif
	vec3 specularBRDF = BRDF_GGX( directLight.direction, geometryViewDir, geometryNormal, material );
	#ifdef USE_RETROREFLECTION
		vec3 retroViewDir = reflect( - geometryViewDir, geometryNormal );
		vec3 retroSpecularBRDF = BRDF_GGX( directLight.direction, retroViewDir, geometryNormal, material );
		specularBRDF = mix( specularBRDF, retroSpecularBRDF, saturate( material.retroreflectivity ) );
	#endif
	reflectedLight.directSpecular += irradiance * specularBRDF * material.multiScatteringCompensation;
	vec3 halfDir = normalize( directLight.direction + geometryViewDir );
	float dotVH = saturate( dot( geometryViewDir, halfDir ) );
	vec3 F = F_Schlick( material.specularColor, material.specularF90, dotVH );
	#ifdef USE_RETROREFLECTION
		vec3 retroHalfDir = normalize( directLight.direction + retroViewDir );
		float dotRetroVH = saturate( dot( retroViewDir, retroHalfDir ) );
		vec3 retroF = F_Schlick( material.specularColor, material.specularF90, dotRetroVH );
		F = mix( F, retroF, saturate( material.retroreflectivity ) );
	#endif
	#ifdef USE_DIFFUSE_ROUGHNESS
		vec3 diffuseBRDF = BRDF_EON( directLight.direction, geometryViewDir, geometryNormal, material.diffuseColor, material.diffuseRoughness ) * ( 1.0 - material.metalness );
	#else
		vec3 diffuseBRDF = BRDF_Lambert( material.diffuseContribution );
	#endif
	reflectedLight.directDiffuse += irradiance * diffuseBRDF * ( 1.0 - F );
}
void RE_IndirectDiffuse_Physical( const in vec3 irradiance, const in vec3 geometryPosition, const in vec3 geometryNormal, const in vec3 geometryViewDir, const in vec3 geometryClearcoatNormal, const in PhysicalMaterial material, inout ReflectedLight reflectedLight ) {
	vec3 singleScattering = vec3( 0.0 );
	vec3 multiScattering = vec3( 0.0 );
	#ifdef USE_IRIDESCENCE
		computeMultiscatteringIridescence( material.dfg, material.specularColor, material.specularF90, material.iridescence, material.iridescenceF0Dielectric, singleScattering, multiScattering );
	#else
		computeMultiscattering( material.dfg, material.specularColor, material.specularF90, singleScattering, multiScattering );
	#endif
	#ifdef USE_DIFFUSE_ROUGHNESS
		float dotNV = saturate( dot( geometryNormal, geometryViewDir ) );
		vec3 diffuseAlbedo = EON_DirectionalAlbedo( material.diffuseColor, material.diffuseRoughness, dotNV ) * ( 1.0 - material.metalness );
		vec3 diffuse = irradiance * RECIPROCAL_PI * diffuseAlbedo * ( 1.0 - singleScattering - multiScattering );
	#else
		vec3 diffuse = irradiance * BRDF_Lambert( material.diffuseContribution ) * ( 1.0 - singleScattering - multiScattering );
	#endif
	#ifdef USE_SHEEN
		float sheenAlbedo = IBLSheenBRDF( geometryNormal, geometryViewDir, material.sheenRoughness );
		sheenSpecularIndirect += irradiance * material.sheenColor * sheenAlbedo * RECIPROCAL_PI;
		float sheenEnergyComp = 1.0 - max3( material.sheenColor ) * sheenAlbedo;
		diffuse *= sheenEnergyComp;
	#endif
	reflectedLight.indirectDiffuse += diffuse;
}
void RE_IndirectSpecular_Physical( const in vec3 radiance, const in vec3 irradiance, const in vec3 clearcoatRadiance, const in vec3 geometryPosition, const in vec3 geometryNormal, const in vec3 geometryViewDir, const in vec3 geometryClearcoatNormal, const in PhysicalMaterial material, inout ReflectedLight reflectedLight) {
	#ifdef USE_CLEARCOAT
		clearcoatSpecularIndirect += clearcoatRadiance * EnvironmentBRDF( geometryClearcoatNormal, geometryViewDir, material.clearcoatF0, material.clearcoatF90, material.clearcoatRoughness );
	#endif
	#ifdef USE_SHEEN
		sheenSpecularIndirect += irradiance * material.sheenColor * IBLSheenBRDF( geometryNormal, geometryViewDir, material.sheenRoughness ) * RECIPROCAL_PI;
 	#endif
	vec3 singleScatteringDielectric = vec3( 0.0 );
	vec3 multiScatteringDielectric = vec3( 0.0 );
	vec3 singleScatteringMetallic = vec3( 0.0 );
	vec3 multiScatteringMetallic = vec3( 0.0 );
	#ifdef USE_IRIDESCENCE
		computeMultiscatteringIridescence( material.dfg, material.specularColor, material.specularF90, material.iridescence, material.iridescenceF0Dielectric, singleScatteringDielectric, multiScatteringDielectric );
		computeMultiscatteringIridescence( material.dfg, material.diffuseColor, material.specularF90, material.iridescence, material.iridescenceF0Metallic, singleScatteringMetallic, multiScatteringMetallic );
	#else
		computeMultiscattering( material.dfg, material.specularColor, material.specularF90, singleScatteringDielectric, multiScatteringDielectric );
		computeMultiscattering( material.dfg, material.diffuseColor, material.specularF90, singleScatteringMetallic, multiScatteringMetallic );
	#endif
	vec3 singleScattering = mix( singleScatteringDielectric, singleScatteringMetallic, material.metalness );
	vec3 multiScattering = mix( multiScatteringDielectric, multiScatteringMetallic, material.metalness );
	vec3 totalScatteringDielectric = singleScatteringDielectric + multiScatteringDielectric;
	#ifdef USE_DIFFUSE_ROUGHNESS
		float dotNV = saturate( dot( geometryNormal, geometryViewDir ) );
		vec3 diffuse = EON_DirectionalAlbedo( material.diffuseColor, material.diffuseRoughness, dotNV ) * ( 1.0 - material.metalness ) * ( 1.0 - totalScatteringDielectric );
	#else
		vec3 diffuse = material.diffuseContribution * ( 1.0 - totalScatteringDielectric );
	#endif
	vec3 cosineWeightedIrradiance = irradiance * RECIPROCAL_PI;
	vec3 indirectSpecular = radiance * singleScattering;
	indirectSpecular += multiScattering * cosineWeightedIrradiance;
	vec3 indirectDiffuse = diffuse * cosineWeightedIrradiance;
	#ifdef USE_SHEEN
		float sheenAlbedo = IBLSheenBRDF( geometryNormal, geometryViewDir, material.sheenRoughness );
		float sheenEnergyComp = 1.0 - max3( material.sheenColor ) * sheenAlbedo;
		indirectSpecular *= sheenEnergyComp;
		indirectDiffuse *= sheenEnergyComp;
	#endif
	reflectedLight.indirectSpecular += indirectSpecular;
	reflectedLight.indirectDiffuse += indirectDiffuse;
}
#define RE_Direct				RE_Direct_Physical
#define RE_Direct_RectArea		RE_Direct_RectArea_Physical
#define RE_IndirectDiffuse		RE_IndirectDiffuse_Physical
#define RE_IndirectSpecular		RE_IndirectSpecular_Physical
float computeSpecularOcclusion( const in float dotNV, const in float ambientOcclusion, const in float roughness ) {
	return saturate( pow( dotNV + ambientOcclusion, exp2( - 16.0 * roughness - 1.0 ) ) - 1.0 + ambientOcclusion );
}`,mx=`
vec3 geometryPosition = - vViewPosition;
vec3 geometryNormal = normal;
vec3 geometryViewDir = ( isOrthographic ) ? vec3( 0, 0, 1 ) : normalize( vViewPosition );
vec3 geometryClearcoatNormal = vec3( 0.0 );
#ifdef USE_CLEARCOAT
	geometryClearcoatNormal = clearcoatNormal;
#endif
#ifdef USE_IRIDESCENCE
	float dotNVi = saturate( dot( normal, geometryViewDir ) );
	if ( material.iridescenceThickness == 0.0 ) {
		material.iridescence = 0.0;
	} else {
		material.iridescence = saturate( material.iridescence );
	}
	if ( material.iridescence > 0.0 ) {
		vec3 iridescenceFresnelDielectric = evalIridescence( 1.0, material.iridescenceIOR, dotNVi, material.iridescenceThickness, material.specularColor );
		vec3 iridescenceFresnelMetallic = evalIridescence( 1.0, material.iridescenceIOR, dotNVi, material.iridescenceThickness, material.diffuseColor );
		material.iridescenceFresnel = mix( iridescenceFresnelDielectric, iridescenceFresnelMetallic, material.metalness );
		material.iridescenceF0Dielectric = Schlick_to_F0( iridescenceFresnelDielectric, 1.0, dotNVi );
		material.iridescenceF0Metallic = Schlick_to_F0( iridescenceFresnelMetallic, 1.0, dotNVi );
	}
#endif
#ifdef STANDARD
	float dotNVms = saturate( dot( geometryNormal, geometryViewDir ) );
	material.dfg = texture2D( dfgLUT, vec2( material.roughness, dotNVms ) ).rg;
	#if ( NUM_SUN_LIGHTS > 0 || NUM_DIR_LIGHTS > 0 || NUM_POINT_LIGHTS > 0 || NUM_SPOT_LIGHTS > 0 )
		float EssMs = material.dfg.x + material.dfg.y;
		material.multiScatteringCompensation = 1.0 + material.specularColorBlended * ( 1.0 / EssMs - 1.0 );
	#endif
#endif
IncidentLight directLight;
#if ( NUM_POINT_LIGHTS > 0 ) && defined( RE_Direct )
	PointLight pointLight;
	#if defined( USE_SHADOWMAP ) && NUM_POINT_LIGHT_SHADOWS > 0
	PointLightShadow pointLightShadow;
	#endif
	#pragma unroll_loop_start
	for ( int i = 0; i < NUM_POINT_LIGHTS; i ++ ) {
		pointLight = pointLights[ i ];
		getPointLightInfo( pointLight, geometryPosition, directLight );
		#if defined( USE_SHADOWMAP ) && ( UNROLLED_LOOP_INDEX < NUM_POINT_LIGHT_SHADOWS ) && ( defined( SHADOWMAP_TYPE_PCF ) || defined( SHADOWMAP_TYPE_BASIC ) )
		pointLightShadow = pointLightShadows[ i ];
		directLight.color *= ( directLight.visible && receiveShadow ) ? getPointShadow( pointShadowMap[ i ], pointLightShadow.shadowMapSize, pointLightShadow.shadowIntensity, pointLightShadow.shadowBias, pointLightShadow.shadowRadius, vPointShadowCoord[ i ], pointLightShadow.shadowCameraNear, pointLightShadow.shadowCameraFar ) : 1.0;
		#endif
		RE_Direct( directLight, geometryPosition, geometryNormal, geometryViewDir, geometryClearcoatNormal, material, reflectedLight );
	}
	#pragma unroll_loop_end
#endif
#if ( NUM_SPOT_LIGHTS > 0 ) && defined( RE_Direct )
	SpotLight spotLight;
	vec4 spotColor;
	vec3 spotLightCoord;
	bool inSpotLightMap;
	#if defined( USE_SHADOWMAP ) && NUM_SPOT_LIGHT_SHADOWS > 0
	SpotLightShadow spotLightShadow;
	#endif
	#pragma unroll_loop_start
	for ( int i = 0; i < NUM_SPOT_LIGHTS; i ++ ) {
		spotLight = spotLights[ i ];
		getSpotLightInfo( spotLight, geometryPosition, directLight );
		#if ( UNROLLED_LOOP_INDEX < NUM_SPOT_LIGHT_SHADOWS_WITH_MAPS )
		#define SPOT_LIGHT_MAP_INDEX UNROLLED_LOOP_INDEX
		#elif ( UNROLLED_LOOP_INDEX < NUM_SPOT_LIGHT_SHADOWS )
		#define SPOT_LIGHT_MAP_INDEX NUM_SPOT_LIGHT_MAPS
		#else
		#define SPOT_LIGHT_MAP_INDEX ( UNROLLED_LOOP_INDEX - NUM_SPOT_LIGHT_SHADOWS + NUM_SPOT_LIGHT_SHADOWS_WITH_MAPS )
		#endif
		#if ( SPOT_LIGHT_MAP_INDEX < NUM_SPOT_LIGHT_MAPS )
			spotLightCoord = vSpotLightCoord[ i ].xyz / vSpotLightCoord[ i ].w;
			inSpotLightMap = all( lessThan( abs( spotLightCoord * 2. - 1. ), vec3( 1.0 ) ) );
			spotColor = texture2D( spotLightMap[ SPOT_LIGHT_MAP_INDEX ], spotLightCoord.xy );
			directLight.color = inSpotLightMap ? directLight.color * spotColor.rgb : directLight.color;
		#endif
		#undef SPOT_LIGHT_MAP_INDEX
		#if defined( USE_SHADOWMAP ) && ( UNROLLED_LOOP_INDEX < NUM_SPOT_LIGHT_SHADOWS )
		spotLightShadow = spotLightShadows[ i ];
		directLight.color *= ( directLight.visible && receiveShadow ) ? getShadow( spotShadowMap[ i ], spotLightShadow.shadowMapSize, spotLightShadow.shadowIntensity, spotLightShadow.shadowBias, spotLightShadow.shadowRadius, vSpotLightCoord[ i ] ) : 1.0;
		#endif
		RE_Direct( directLight, geometryPosition, geometryNormal, geometryViewDir, geometryClearcoatNormal, material, reflectedLight );
	}
	#pragma unroll_loop_end
#endif
#if ( NUM_SUN_LIGHTS > 0 ) && defined( RE_Direct )
	SunLight sunLight;
	#if defined( USE_SHADOWMAP ) && NUM_SUN_LIGHT_SHADOWS > 0
	SunLightShadow sunLightShadow;
	#endif
	#pragma unroll_loop_start
	for ( int i = 0; i < NUM_SUN_LIGHTS; i ++ ) {
		sunLight = sunLights[ i ];
		getSunLightInfo( sunLight, directLight );
		#if defined( USE_SHADOWMAP ) && ( UNROLLED_LOOP_INDEX < NUM_SUN_LIGHT_SHADOWS )
		sunLightShadow = sunLightShadows[ i ];
		directLight.color *= ( directLight.visible && receiveShadow ) ? getSunShadow( sunShadowMap[ i ], sunLightShadow, UNROLLED_LOOP_INDEX ) : 1.0;
		#endif
		RE_Direct( directLight, geometryPosition, geometryNormal, geometryViewDir, geometryClearcoatNormal, material, reflectedLight );
	}
	#pragma unroll_loop_end
#endif
#if ( NUM_DIR_LIGHTS > 0 ) && defined( RE_Direct )
	DirectionalLight directionalLight;
	#if defined( USE_SHADOWMAP ) && NUM_DIR_LIGHT_SHADOWS > 0
	DirectionalLightShadow directionalLightShadow;
	#endif
	#pragma unroll_loop_start
	for ( int i = 0; i < NUM_DIR_LIGHTS; i ++ ) {
		directionalLight = directionalLights[ i ];
		getDirectionalLightInfo( directionalLight, directLight );
		#if defined( USE_SHADOWMAP ) && ( UNROLLED_LOOP_INDEX < NUM_DIR_LIGHT_SHADOWS )
		directionalLightShadow = directionalLightShadows[ i ];
		directLight.color *= ( directLight.visible && receiveShadow ) ? getShadow( directionalShadowMap[ i ], directionalLightShadow.shadowMapSize, directionalLightShadow.shadowIntensity, directionalLightShadow.shadowBias, directionalLightShadow.shadowRadius, vDirectionalShadowCoord[ i ] ) : 1.0;
		#endif
		RE_Direct( directLight, geometryPosition, geometryNormal, geometryViewDir, geometryClearcoatNormal, material, reflectedLight );
	}
	#pragma unroll_loop_end
#endif
#if ( NUM_RECT_AREA_LIGHTS > 0 ) && defined( RE_Direct_RectArea )
	RectAreaLight rectAreaLight;
	#pragma unroll_loop_start
	for ( int i = 0; i < NUM_RECT_AREA_LIGHTS; i ++ ) {
		rectAreaLight = rectAreaLights[ i ];
		RE_Direct_RectArea( rectAreaLight, geometryPosition, geometryNormal, geometryViewDir, geometryClearcoatNormal, material, reflectedLight );
	}
	#pragma unroll_loop_end
#endif
#if defined( RE_IndirectDiffuse )
	vec3 iblIrradiance = vec3( 0.0 );
	vec3 irradiance = getAmbientLightIrradiance( ambientLightColor );
	#if defined( USE_LIGHT_PROBES )
		irradiance += getLightProbeIrradiance( lightProbe, geometryNormal );
	#endif
	#if ( NUM_HEMI_LIGHTS > 0 )
		#pragma unroll_loop_start
		for ( int i = 0; i < NUM_HEMI_LIGHTS; i ++ ) {
			irradiance += getHemisphereLightIrradiance( hemisphereLights[ i ], geometryNormal );
		}
		#pragma unroll_loop_end
	#endif
	#if NUM_LIGHT_PROBE_GRIDS > 0
		vec3 probeWorldPos = ( ( vec4( geometryPosition, 1.0 ) - viewMatrix[ 3 ] ) * viewMatrix ).xyz;
		vec3 probeWorldNormal = transformNormalByInverseViewMatrix( geometryNormal, viewMatrix );
		int probeGrid = - 1;
		#pragma unroll_loop_start
		for ( int i = 0; i < NUM_LIGHT_PROBE_GRIDS; i ++ ) {
			if ( isInsideLightProbeGrid( probeWorldPos, probeWorldNormal, probesMin[ i ], probesMax[ i ], probesResolution[ i ] ) ) probeGrid = UNROLLED_LOOP_INDEX;
		}
		#pragma unroll_loop_end
		#pragma unroll_loop_start
		for ( int i = 0; i < NUM_LIGHT_PROBE_GRIDS; i ++ ) {
			if ( probeGrid == UNROLLED_LOOP_INDEX ) irradiance += getLightProbeGridIrradiance( probesSH[ i ], probesMin[ i ], probesMax[ i ], probesResolution[ i ], probeWorldPos, probeWorldNormal );
		}
		#pragma unroll_loop_end
	#endif
#endif
#if defined( RE_IndirectSpecular )
	vec3 radiance = vec3( 0.0 );
	vec3 clearcoatRadiance = vec3( 0.0 );
#endif`,gx=`#if defined( RE_IndirectDiffuse )
	#ifdef USE_LIGHTMAP
		vec4 lightMapTexel = texture2D( lightMap, vLightMapUv );
		vec3 lightMapIrradiance = lightMapTexel.rgb * lightMapIntensity;
		irradiance += lightMapIrradiance;
	#endif
	#if defined( USE_ENVMAP ) && defined( ENVMAP_TYPE_PMREM )
		#if defined( STANDARD ) || defined( LAMBERT ) || defined( PHONG )
			iblIrradiance += getIBLIrradiance( geometryNormal );
		#endif
	#endif
#endif
#if defined( USE_ENVMAP ) && defined( RE_IndirectSpecular )
	#ifdef USE_ANISOTROPY
		vec3 iblRadiance = getIBLAnisotropyRadiance( geometryViewDir, geometryNormal, material.roughness, material.anisotropyB, material.anisotropy );
	#else
		vec3 iblRadiance = getIBLRadiance( geometryViewDir, geometryNormal, material.roughness );
	#endif
	#ifdef USE_RETROREFLECTION
		#ifdef USE_ANISOTROPY
			vec3 retroIBLRadiance = getIBLAnisotropyRetroRadiance( geometryViewDir, geometryNormal, material.roughness, material.anisotropyB, material.anisotropy );
		#else
			vec3 retroIBLRadiance = getIBLRetroRadiance( geometryViewDir, geometryNormal, material.roughness );
		#endif
		iblRadiance = mix( iblRadiance, retroIBLRadiance, saturate( material.retroreflectivity ) );
	#endif
	radiance += iblRadiance;
	#ifdef USE_CLEARCOAT
		clearcoatRadiance += getIBLRadiance( geometryViewDir, geometryClearcoatNormal, material.clearcoatRoughness );
	#endif
#endif`,vx=`#if defined( RE_IndirectDiffuse )
	#if defined( LAMBERT ) || defined( PHONG )
		irradiance += iblIrradiance;
	#endif
	RE_IndirectDiffuse( irradiance, geometryPosition, geometryNormal, geometryViewDir, geometryClearcoatNormal, material, reflectedLight );
#endif
#if defined( RE_IndirectSpecular )
	RE_IndirectSpecular( radiance, iblIrradiance, clearcoatRadiance, geometryPosition, geometryNormal, geometryViewDir, geometryClearcoatNormal, material, reflectedLight );
#endif`,_x=`#if NUM_LIGHT_PROBE_GRIDS > 0
uniform highp sampler3D probesSH[ NUM_LIGHT_PROBE_GRIDS ];
uniform vec3 probesMin[ NUM_LIGHT_PROBE_GRIDS ];
uniform vec3 probesMax[ NUM_LIGHT_PROBE_GRIDS ];
uniform vec3 probesResolution[ NUM_LIGHT_PROBE_GRIDS ];
bool isInsideLightProbeGrid( vec3 worldPos, vec3 worldNormal, vec3 probesMin, vec3 probesMax, vec3 probesResolution ) {
	vec3 spacing = ( probesMax - probesMin ) / probesResolution;
	vec3 samplePos = worldPos + worldNormal * spacing * 0.5;
	vec3 margin = spacing * 0.01;
	return all( greaterThanEqual( samplePos, probesMin - margin ) ) && all( lessThanEqual( samplePos, probesMax + margin ) );
}
vec3 getLightProbeGridIrradiance( highp sampler3D probesSH, vec3 probesMin, vec3 probesMax, vec3 probesResolution, vec3 worldPos, vec3 worldNormal ) {
	vec3 res = probesResolution;
	vec3 gridRange = probesMax - probesMin;
	vec3 probeSpacing = gridRange / res;
	vec3 samplePos = worldPos + worldNormal * probeSpacing * 0.5;
	vec3 uvw = clamp( ( samplePos - probesMin ) / gridRange, 0.5 / res, 1.0 - 0.5 / res );
	float nz          = res.z;
	float paddedSlices = nz + 2.0;
	float atlasDepth  = 7.0 * paddedSlices;
	float uvZBase     = uvw.z * nz + 1.0;
	vec4 s0 = texture( probesSH, vec3( uvw.xy, ( uvZBase                       ) / atlasDepth ) );
	vec4 s1 = texture( probesSH, vec3( uvw.xy, ( uvZBase +       paddedSlices   ) / atlasDepth ) );
	vec4 s2 = texture( probesSH, vec3( uvw.xy, ( uvZBase + 2.0 * paddedSlices   ) / atlasDepth ) );
	vec4 s3 = texture( probesSH, vec3( uvw.xy, ( uvZBase + 3.0 * paddedSlices   ) / atlasDepth ) );
	vec4 s4 = texture( probesSH, vec3( uvw.xy, ( uvZBase + 4.0 * paddedSlices   ) / atlasDepth ) );
	vec4 s5 = texture( probesSH, vec3( uvw.xy, ( uvZBase + 5.0 * paddedSlices   ) / atlasDepth ) );
	vec4 s6 = texture( probesSH, vec3( uvw.xy, ( uvZBase + 6.0 * paddedSlices   ) / atlasDepth ) );
	vec3 c0 = s0.xyz;
	vec3 c1 = vec3( s0.w, s1.xy );
	vec3 c2 = vec3( s1.zw, s2.x );
	vec3 c3 = s2.yzw;
	vec3 c4 = s3.xyz;
	vec3 c5 = vec3( s3.w, s4.xy );
	vec3 c6 = vec3( s4.zw, s5.x );
	vec3 c7 = s5.yzw;
	vec3 c8 = s6.xyz;
	float x = worldNormal.x, y = worldNormal.y, z = worldNormal.z;
	vec3 result = c0 * 0.886227;
	result += c1 * 2.0 * 0.511664 * y;
	result += c2 * 2.0 * 0.511664 * z;
	result += c3 * 2.0 * 0.511664 * x;
	result += c4 * 2.0 * 0.429043 * x * y;
	result += c5 * 2.0 * 0.429043 * y * z;
	result += c6 * ( 0.743125 * z * z - 0.247708 );
	result += c7 * 2.0 * 0.429043 * x * z;
	result += c8 * 0.429043 * ( x * x - y * y );
	return max( result, vec3( 0.0 ) );
}
#endif`,xx=`#if defined( USE_LOGARITHMIC_DEPTH_BUFFER )
	gl_FragDepth = vIsPerspective == 0.0 ? gl_FragCoord.z : log2( vFragDepth ) * logDepthBufFC * 0.5;
#endif`,yx=`#if defined( USE_LOGARITHMIC_DEPTH_BUFFER )
	uniform float logDepthBufFC;
	varying float vFragDepth;
	varying float vIsPerspective;
#endif`,bx=`#ifdef USE_LOGARITHMIC_DEPTH_BUFFER
	varying float vFragDepth;
	varying float vIsPerspective;
#endif`,Sx=`#ifdef USE_LOGARITHMIC_DEPTH_BUFFER
	vFragDepth = 1.0 + gl_Position.w;
	vIsPerspective = float( isPerspectiveMatrix( projectionMatrix ) );
#endif`,Mx=`#ifdef USE_MAP
	vec4 sampledDiffuseColor = texture2D( map, vMapUv );
	#ifdef DECODE_VIDEO_TEXTURE
		sampledDiffuseColor = sRGBTransferEOTF( sampledDiffuseColor );
	#endif
	diffuseColor *= sampledDiffuseColor;
#endif`,wx=`#ifdef USE_MAP
	uniform sampler2D map;
#endif`,Ex=`#if defined( USE_MAP ) || defined( USE_ALPHAMAP )
	#if defined( USE_POINTS_UV )
		vec2 uv = vUv;
	#else
		vec2 uv = ( uvTransform * vec3( gl_PointCoord.x, 1.0 - gl_PointCoord.y, 1 ) ).xy;
	#endif
#endif
#ifdef USE_MAP
	diffuseColor *= texture2D( map, uv );
#endif
#ifdef USE_ALPHAMAP
	diffuseColor.a *= texture2D( alphaMap, uv ).g;
#endif`,Tx=`#if defined( USE_POINTS_UV )
	varying vec2 vUv;
#else
	#if defined( USE_MAP ) || defined( USE_ALPHAMAP )
		uniform mat3 uvTransform;
	#endif
#endif
#ifdef USE_MAP
	uniform sampler2D map;
#endif
#ifdef USE_ALPHAMAP
	uniform sampler2D alphaMap;
#endif`,Ax=`float metalnessFactor = metalness;
#ifdef USE_METALNESSMAP
	vec4 texelMetalness = texture2D( metalnessMap, vMetalnessMapUv );
	metalnessFactor *= texelMetalness.b;
#endif`,Rx=`#ifdef USE_METALNESSMAP
	uniform sampler2D metalnessMap;
#endif`,Cx=`#ifdef USE_INSTANCING_MORPH
	float morphTargetInfluences[ MORPHTARGETS_COUNT ];
	float morphTargetBaseInfluence = texelFetch( morphTexture, ivec2( 0, gl_InstanceID ), 0 ).r;
	for ( int i = 0; i < MORPHTARGETS_COUNT; i ++ ) {
		morphTargetInfluences[i] =  texelFetch( morphTexture, ivec2( i + 1, gl_InstanceID ), 0 ).r;
	}
#endif`,Px=`#if defined( USE_MORPHCOLORS )
	#if defined( USE_COLOR_ALPHA )
		vColor *= morphTargetBaseInfluence;
	#elif defined( USE_COLOR )
		vColor.rgb *= morphTargetBaseInfluence;
	#endif
	for ( int i = 0; i < MORPHTARGETS_COUNT; i ++ ) {
		#if defined( USE_COLOR_ALPHA )
			if ( morphTargetInfluences[ i ] != 0.0 ) vColor += getMorph( gl_VertexID, i, 2 ) * morphTargetInfluences[ i ];
		#elif defined( USE_COLOR )
			if ( morphTargetInfluences[ i ] != 0.0 ) vColor.rgb += getMorph( gl_VertexID, i, 2 ).rgb * morphTargetInfluences[ i ];
		#endif
	}
#endif`,Ix=`#ifdef USE_MORPHNORMALS
	objectNormal *= morphTargetBaseInfluence;
	for ( int i = 0; i < MORPHTARGETS_COUNT; i ++ ) {
		if ( morphTargetInfluences[ i ] != 0.0 ) objectNormal += getMorph( gl_VertexID, i, 1 ).xyz * morphTargetInfluences[ i ];
	}
#endif`,Lx=`#ifdef USE_MORPHTARGETS
	#ifndef USE_INSTANCING_MORPH
		uniform float morphTargetBaseInfluence;
		uniform float morphTargetInfluences[ MORPHTARGETS_COUNT ];
	#endif
	uniform sampler2DArray morphTargetsTexture;
	uniform ivec2 morphTargetsTextureSize;
	vec4 getMorph( const in int vertexIndex, const in int morphTargetIndex, const in int offset ) {
		int texelIndex = vertexIndex * MORPHTARGETS_TEXTURE_STRIDE + offset;
		int y = texelIndex / morphTargetsTextureSize.x;
		int x = texelIndex - y * morphTargetsTextureSize.x;
		ivec3 morphUV = ivec3( x, y, morphTargetIndex );
		return texelFetch( morphTargetsTexture, morphUV, 0 );
	}
#endif`,Dx=`#ifdef USE_MORPHTARGETS
	transformed *= morphTargetBaseInfluence;
	for ( int i = 0; i < MORPHTARGETS_COUNT; i ++ ) {
		if ( morphTargetInfluences[ i ] != 0.0 ) transformed += getMorph( gl_VertexID, i, 0 ).xyz * morphTargetInfluences[ i ];
	}
#endif`,Nx=`float faceDirection = gl_FrontFacing ? 1.0 : - 1.0;
#ifdef FLAT_SHADED
	vec3 fdx = dFdx( vViewPosition );
	vec3 fdy = dFdy( vViewPosition );
	vec3 normal = normalize( cross( fdx, fdy ) );
#else
	vec3 normal = normalize( vNormal );
	#ifdef DOUBLE_SIDED
		normal *= faceDirection;
	#endif
#endif
#if defined( USE_NORMALMAP_TANGENTSPACE ) || defined( USE_CLEARCOAT_NORMALMAP ) || defined( USE_ANISOTROPY )
	#ifdef USE_TANGENT
		mat3 tbn = mat3( normalize( vTangent ), normalize( vBitangent ), normal );
	#else
		mat3 tbn = getTangentFrame( - vViewPosition, normal,
		#if defined( USE_NORMALMAP )
			vNormalMapUv
		#elif defined( USE_CLEARCOAT_NORMALMAP )
			vClearcoatNormalMapUv
		#else
			vUv
		#endif
		);
	#endif
	#ifdef DOUBLE_SIDED
		tbn[0] *= faceDirection;
		tbn[1] *= faceDirection;
	#endif
#endif
#ifdef USE_CLEARCOAT_NORMALMAP
	#ifdef USE_TANGENT
		mat3 tbn2 = mat3( normalize( vTangent ), normalize( vBitangent ), normal );
	#else
		mat3 tbn2 = getTangentFrame( - vViewPosition, normal, vClearcoatNormalMapUv );
	#endif
	#ifdef DOUBLE_SIDED
		tbn2[0] *= faceDirection;
		tbn2[1] *= faceDirection;
	#endif
#endif
vec3 nonPerturbedNormal = normal;`,Fx=`#ifdef USE_NORMALMAP_OBJECTSPACE
	normal = texture2D( normalMap, vNormalMapUv ).xyz * 2.0 - 1.0;
	#ifdef FLIP_SIDED
		normal = - normal;
	#endif
	#ifdef DOUBLE_SIDED
		normal = normal * faceDirection;
	#endif
	normal = normalize( normalMatrix * normal );
#elif defined( USE_NORMALMAP_TANGENTSPACE )
	vec3 mapN = texture2D( normalMap, vNormalMapUv ).xyz * 2.0 - 1.0;
	#if defined( USE_PACKED_NORMALMAP )
		mapN = vec3( mapN.xy, sqrt( saturate( 1.0 - dot( mapN.xy, mapN.xy ) ) ) );
	#endif
	mapN.xy *= normalScale;
	normal = normalize( tbn * mapN );
#elif defined( USE_BUMPMAP )
	normal = perturbNormalArb( - vViewPosition, normal, dHdxy_fwd(), faceDirection );
#endif`,Ux=`#ifndef FLAT_SHADED
	varying vec3 vNormal;
	#ifdef USE_TANGENT
		varying vec3 vTangent;
		varying vec3 vBitangent;
	#endif
#endif`,Ox=`#ifndef FLAT_SHADED
	varying vec3 vNormal;
	#ifdef USE_TANGENT
		varying vec3 vTangent;
		varying vec3 vBitangent;
	#endif
#endif`,Bx=`#ifndef FLAT_SHADED
	vNormal = normalize( transformedNormal );
	#ifdef USE_TANGENT
		vTangent = normalize( transformedTangent );
		vBitangent = normalize( cross( vNormal, vTangent ) * tangent.w );
		#ifdef FLIP_SIDED
			vBitangent = - vBitangent;
		#endif
	#endif
#endif`,kx=`#ifdef USE_NORMALMAP
	uniform sampler2D normalMap;
	uniform vec2 normalScale;
#endif
#ifdef USE_NORMALMAP_OBJECTSPACE
	uniform mat3 normalMatrix;
#endif
#if ! defined ( USE_TANGENT ) && ( defined ( USE_NORMALMAP_TANGENTSPACE ) || defined ( USE_CLEARCOAT_NORMALMAP ) || defined( USE_ANISOTROPY ) )
	mat3 getTangentFrame( vec3 eye_pos, vec3 surf_norm, vec2 uv ) {
		vec3 q0 = dFdx( eye_pos.xyz );
		vec3 q1 = dFdy( eye_pos.xyz );
		vec2 st0 = dFdx( uv.st );
		vec2 st1 = dFdy( uv.st );
		vec3 N = surf_norm;
		vec3 q1perp = cross( q1, N );
		vec3 q0perp = cross( N, q0 );
		vec3 T = q1perp * st0.x + q0perp * st1.x;
		vec3 B = q1perp * st0.y + q0perp * st1.y;
		float det = max( dot( T, T ), dot( B, B ) );
		float scale = ( det == 0.0 ) ? 0.0 : inversesqrt( det );
		return mat3( T * scale, B * scale, N );
	}
#endif`,zx=`#ifdef USE_CLEARCOAT
	vec3 clearcoatNormal = nonPerturbedNormal;
#endif`,Hx=`#ifdef USE_CLEARCOAT_NORMALMAP
	vec3 clearcoatMapN = texture2D( clearcoatNormalMap, vClearcoatNormalMapUv ).xyz * 2.0 - 1.0;
	clearcoatMapN.xy *= clearcoatNormalScale;
	clearcoatNormal = normalize( tbn2 * clearcoatMapN );
#endif`,Vx=`#ifdef USE_CLEARCOATMAP
	uniform sampler2D clearcoatMap;
#endif
#ifdef USE_CLEARCOAT_NORMALMAP
	uniform sampler2D clearcoatNormalMap;
	uniform vec2 clearcoatNormalScale;
#endif
#ifdef USE_CLEARCOAT_ROUGHNESSMAP
	uniform sampler2D clearcoatRoughnessMap;
#endif`,Gx=`#ifdef USE_IRIDESCENCEMAP
	uniform sampler2D iridescenceMap;
#endif
#ifdef USE_IRIDESCENCE_THICKNESSMAP
	uniform sampler2D iridescenceThicknessMap;
#endif`,Wx=`#ifdef OPAQUE
diffuseColor.a = 1.0;
#endif
#ifdef USE_TRANSMISSION
diffuseColor.a *= material.transmissionAlpha;
#endif
gl_FragColor = vec4( outgoingLight, diffuseColor.a );`,Xx=`vec3 packNormalToRGB( const in vec3 normal ) {
	return normalize( normal ) * 0.5 + 0.5;
}
vec3 unpackRGBToNormal( const in vec3 rgb ) {
	return 2.0 * rgb.xyz - 1.0;
}
const float PackUpscale = 256. / 255.;const float UnpackDownscale = 255. / 256.;const float ShiftRight8 = 1. / 256.;
const float Inv255 = 1. / 255.;
const vec4 PackFactors = vec4( 1.0, 256.0, 256.0 * 256.0, 256.0 * 256.0 * 256.0 );
const vec2 UnpackFactors2 = vec2( UnpackDownscale, 1.0 / PackFactors.g );
const vec3 UnpackFactors3 = vec3( UnpackDownscale / PackFactors.rg, 1.0 / PackFactors.b );
const vec4 UnpackFactors4 = vec4( UnpackDownscale / PackFactors.rgb, 1.0 / PackFactors.a );
vec4 packDepthToRGBA( const in float v ) {
	if( v <= 0.0 )
		return vec4( 0., 0., 0., 0. );
	if( v >= 1.0 )
		return vec4( 1., 1., 1., 1. );
	float vuf;
	float af = modf( v * PackFactors.a, vuf );
	float bf = modf( vuf * ShiftRight8, vuf );
	float gf = modf( vuf * ShiftRight8, vuf );
	return vec4( vuf * Inv255, gf * PackUpscale, bf * PackUpscale, af );
}
vec3 packDepthToRGB( const in float v ) {
	if( v <= 0.0 )
		return vec3( 0., 0., 0. );
	if( v >= 1.0 )
		return vec3( 1., 1., 1. );
	float vuf;
	float bf = modf( v * PackFactors.b, vuf );
	float gf = modf( vuf * ShiftRight8, vuf );
	return vec3( vuf * Inv255, gf * PackUpscale, bf );
}
vec2 packDepthToRG( const in float v ) {
	if( v <= 0.0 )
		return vec2( 0., 0. );
	if( v >= 1.0 )
		return vec2( 1., 1. );
	float vuf;
	float gf = modf( v * 256., vuf );
	return vec2( vuf * Inv255, gf );
}
float unpackRGBAToDepth( const in vec4 v ) {
	return dot( v, UnpackFactors4 );
}
float unpackRGBToDepth( const in vec3 v ) {
	return dot( v, UnpackFactors3 );
}
float unpackRGToDepth( const in vec2 v ) {
	return v.r * UnpackFactors2.r + v.g * UnpackFactors2.g;
}
vec4 pack2HalfToRGBA( const in vec2 v ) {
	vec4 r = vec4( v.x, fract( v.x * 255.0 ), v.y, fract( v.y * 255.0 ) );
	return vec4( r.x - r.y / 255.0, r.y, r.z - r.w / 255.0, r.w );
}
vec2 unpackRGBATo2Half( const in vec4 v ) {
	return vec2( v.x + ( v.y / 255.0 ), v.z + ( v.w / 255.0 ) );
}
float viewZToOrthographicDepth( const in float viewZ, const in float near, const in float far ) {
	return ( viewZ + near ) / ( near - far );
}
float orthographicDepthToViewZ( const in float depth, const in float near, const in float far ) {
	#ifdef USE_REVERSED_DEPTH_BUFFER
	
		return depth * ( far - near ) - far;
	#else
		return depth * ( near - far ) - near;
	#endif
}
float viewZToPerspectiveDepth( const in float viewZ, const in float near, const in float far ) {
	return ( ( near + viewZ ) * far ) / ( ( far - near ) * viewZ );
}
float perspectiveDepthToViewZ( const in float depth, const in float near, const in float far ) {
	
	#ifdef USE_REVERSED_DEPTH_BUFFER
		return ( near * far ) / ( ( near - far ) * depth - near );
	#else
		return ( near * far ) / ( ( far - near ) * depth - far );
	#endif
}`,qx=`#ifdef PREMULTIPLIED_ALPHA
	gl_FragColor.rgb *= gl_FragColor.a;
#endif`,Yx=`vec4 mvPosition = vec4( transformed, 1.0 );
#ifdef USE_BATCHING
	mvPosition = batchingMatrix * mvPosition;
#endif
#ifdef USE_INSTANCING
	mvPosition = instanceMatrix * mvPosition;
#endif
mvPosition = modelViewMatrix * mvPosition;
gl_Position = projectionMatrix * mvPosition;`,$x=`#ifdef DITHERING
	gl_FragColor.rgb = dithering( gl_FragColor.rgb );
#endif`,Zx=`#ifdef DITHERING
	vec3 dithering( vec3 color ) {
		float grid_position = rand( gl_FragCoord.xy );
		vec3 dither_shift_RGB = vec3( 0.25 / 255.0, -0.25 / 255.0, 0.25 / 255.0 );
		dither_shift_RGB = mix( 2.0 * dither_shift_RGB, -2.0 * dither_shift_RGB, grid_position );
		return color + dither_shift_RGB;
	}
#endif`,Kx=`float roughnessFactor = roughness;
#ifdef USE_ROUGHNESSMAP
	vec4 texelRoughness = texture2D( roughnessMap, vRoughnessMapUv );
	roughnessFactor *= texelRoughness.g;
#endif`,Jx=`#ifdef USE_ROUGHNESSMAP
	uniform sampler2D roughnessMap;
#endif`,jx=`#if NUM_SPOT_LIGHT_COORDS > 0
	varying vec4 vSpotLightCoord[ NUM_SPOT_LIGHT_COORDS ];
#endif
#if NUM_SPOT_LIGHT_MAPS > 0
	uniform sampler2D spotLightMap[ NUM_SPOT_LIGHT_MAPS ];
#endif
#ifdef USE_SHADOWMAP
	#if NUM_SUN_LIGHT_SHADOWS > 0
		#define SUN_LIGHT_CASCADES 2
		#if defined( SHADOWMAP_TYPE_PCF )
			uniform sampler2DShadow sunShadowMap[ NUM_SUN_LIGHT_SHADOWS ];
		#else
			uniform sampler2D sunShadowMap[ NUM_SUN_LIGHT_SHADOWS ];
		#endif
		uniform mat4 sunShadowMatrix[ NUM_SUN_LIGHT_SHADOWS * SUN_LIGHT_CASCADES ];
		uniform vec4 sunShadowCascade[ NUM_SUN_LIGHT_SHADOWS * SUN_LIGHT_CASCADES ];
		varying vec4 vSunShadowWorldPosition;
		varying vec3 vSunShadowWorldNormal;
		struct SunLightShadow {
			float shadowIntensity;
			float shadowBias;
			float shadowNormalBias;
			float shadowRadius;
			vec2 shadowMapSize;
		};
		uniform SunLightShadow sunLightShadows[ NUM_SUN_LIGHT_SHADOWS ];
	#endif
	#if NUM_DIR_LIGHT_SHADOWS > 0
		#if defined( SHADOWMAP_TYPE_PCF )
			uniform sampler2DShadow directionalShadowMap[ NUM_DIR_LIGHT_SHADOWS ];
		#else
			uniform sampler2D directionalShadowMap[ NUM_DIR_LIGHT_SHADOWS ];
		#endif
		varying vec4 vDirectionalShadowCoord[ NUM_DIR_LIGHT_SHADOWS ];
		struct DirectionalLightShadow {
			float shadowIntensity;
			float shadowBias;
			float shadowNormalBias;
			float shadowRadius;
			vec2 shadowMapSize;
		};
		uniform DirectionalLightShadow directionalLightShadows[ NUM_DIR_LIGHT_SHADOWS ];
	#endif
	#if NUM_SPOT_LIGHT_SHADOWS > 0
		#if defined( SHADOWMAP_TYPE_PCF )
			uniform sampler2DShadow spotShadowMap[ NUM_SPOT_LIGHT_SHADOWS ];
		#else
			uniform sampler2D spotShadowMap[ NUM_SPOT_LIGHT_SHADOWS ];
		#endif
		struct SpotLightShadow {
			float shadowIntensity;
			float shadowBias;
			float shadowNormalBias;
			float shadowRadius;
			vec2 shadowMapSize;
		};
		uniform SpotLightShadow spotLightShadows[ NUM_SPOT_LIGHT_SHADOWS ];
	#endif
	#if NUM_POINT_LIGHT_SHADOWS > 0
		#if defined( SHADOWMAP_TYPE_PCF )
			uniform samplerCubeShadow pointShadowMap[ NUM_POINT_LIGHT_SHADOWS ];
		#elif defined( SHADOWMAP_TYPE_BASIC )
			uniform samplerCube pointShadowMap[ NUM_POINT_LIGHT_SHADOWS ];
		#endif
		varying vec4 vPointShadowCoord[ NUM_POINT_LIGHT_SHADOWS ];
		struct PointLightShadow {
			float shadowIntensity;
			float shadowBias;
			float shadowNormalBias;
			float shadowRadius;
			vec2 shadowMapSize;
			float shadowCameraNear;
			float shadowCameraFar;
		};
		uniform PointLightShadow pointLightShadows[ NUM_POINT_LIGHT_SHADOWS ];
	#endif
	#if defined( SHADOWMAP_TYPE_PCF )
		float interleavedGradientNoise( vec2 position ) {
			return fract( 52.9829189 * fract( dot( position, vec2( 0.06711056, 0.00583715 ) ) ) );
		}
		vec2 vogelDiskSample( int sampleIndex, int samplesCount, float phi ) {
			const float goldenAngle = 2.399963229728653;
			float r = sqrt( ( float( sampleIndex ) + 0.5 ) / float( samplesCount ) );
			float theta = float( sampleIndex ) * goldenAngle + phi;
			return vec2( cos( theta ), sin( theta ) ) * r;
		}
	#endif
	#if defined( SHADOWMAP_TYPE_PCF )
		float getShadow( sampler2DShadow shadowMap, vec2 shadowMapSize, float shadowIntensity, float shadowBias, float shadowRadius, vec4 shadowCoord ) {
			float shadow = 1.0;
			shadowCoord.xyz /= shadowCoord.w;
			#ifdef USE_REVERSED_DEPTH_BUFFER
				shadowCoord.z -= shadowBias;
			#else
				shadowCoord.z += shadowBias;
			#endif
			bool inFrustum = shadowCoord.x >= 0.0 && shadowCoord.x <= 1.0 && shadowCoord.y >= 0.0 && shadowCoord.y <= 1.0;
			bool frustumTest = inFrustum && shadowCoord.z <= 1.0;
			if ( frustumTest ) {
				vec2 texelSize = vec2( 1.0 ) / shadowMapSize;
				vec2 radius = shadowRadius * texelSize;
				float phi = interleavedGradientNoise( gl_FragCoord.xy ) * PI2;
				shadow = (
					texture( shadowMap, vec3( shadowCoord.xy + vogelDiskSample( 0, 5, phi ) * radius, shadowCoord.z ) ) +
					texture( shadowMap, vec3( shadowCoord.xy + vogelDiskSample( 1, 5, phi ) * radius, shadowCoord.z ) ) +
					texture( shadowMap, vec3( shadowCoord.xy + vogelDiskSample( 2, 5, phi ) * radius, shadowCoord.z ) ) +
					texture( shadowMap, vec3( shadowCoord.xy + vogelDiskSample( 3, 5, phi ) * radius, shadowCoord.z ) ) +
					texture( shadowMap, vec3( shadowCoord.xy + vogelDiskSample( 4, 5, phi ) * radius, shadowCoord.z ) )
				) * 0.2;
			}
			return mix( 1.0, shadow, shadowIntensity );
		}
	#elif defined( SHADOWMAP_TYPE_VSM )
		float getShadow( sampler2D shadowMap, vec2 shadowMapSize, float shadowIntensity, float shadowBias, float shadowRadius, vec4 shadowCoord ) {
			float shadow = 1.0;
			shadowCoord.xyz /= shadowCoord.w;
			#ifdef USE_REVERSED_DEPTH_BUFFER
				shadowCoord.z -= shadowBias;
			#else
				shadowCoord.z += shadowBias;
			#endif
			bool inFrustum = shadowCoord.x >= 0.0 && shadowCoord.x <= 1.0 && shadowCoord.y >= 0.0 && shadowCoord.y <= 1.0;
			bool frustumTest = inFrustum && shadowCoord.z <= 1.0;
			if ( frustumTest ) {
				vec2 distribution = texture2D( shadowMap, shadowCoord.xy ).rg;
				float mean = distribution.x;
				float variance = distribution.y * distribution.y;
				#ifdef USE_REVERSED_DEPTH_BUFFER
					float hard_shadow = step( mean, shadowCoord.z );
				#else
					float hard_shadow = step( shadowCoord.z, mean );
				#endif
				
				if ( hard_shadow == 1.0 ) {
					shadow = 1.0;
				} else {
					variance = max( variance, 0.0000001 );
					float d = shadowCoord.z - mean;
					float p_max = variance / ( variance + d * d );
					p_max = clamp( ( p_max - 0.3 ) / 0.65, 0.0, 1.0 );
					shadow = max( hard_shadow, p_max );
				}
			}
			return mix( 1.0, shadow, shadowIntensity );
		}
	#else
		float getShadow( sampler2D shadowMap, vec2 shadowMapSize, float shadowIntensity, float shadowBias, float shadowRadius, vec4 shadowCoord ) {
			float shadow = 1.0;
			shadowCoord.xyz /= shadowCoord.w;
			#ifdef USE_REVERSED_DEPTH_BUFFER
				shadowCoord.z -= shadowBias;
			#else
				shadowCoord.z += shadowBias;
			#endif
			bool inFrustum = shadowCoord.x >= 0.0 && shadowCoord.x <= 1.0 && shadowCoord.y >= 0.0 && shadowCoord.y <= 1.0;
			bool frustumTest = inFrustum && shadowCoord.z <= 1.0;
			if ( frustumTest ) {
				float depth = texture2D( shadowMap, shadowCoord.xy ).r;
				#ifdef USE_REVERSED_DEPTH_BUFFER
					shadow = step( depth, shadowCoord.z );
				#else
					shadow = step( shadowCoord.z, depth );
				#endif
			}
			return mix( 1.0, shadow, shadowIntensity );
		}
	#endif
	#if NUM_SUN_LIGHT_SHADOWS > 0
		float getSunShadow(
			#if defined( SHADOWMAP_TYPE_PCF )
				sampler2DShadow shadowMap,
			#else
				sampler2D shadowMap,
			#endif
			SunLightShadow sunLightShadow,
			int shadowIndex
		) {
			vec4 shadowWorldPosition = vec4( vSunShadowWorldPosition.xyz + vSunShadowWorldNormal * sunLightShadow.shadowNormalBias, 1.0 );
			float viewDepth = vSunShadowWorldPosition.w;
			int cascadeOffset = shadowIndex * SUN_LIGHT_CASCADES;
			float shadow = 1.0;
			for ( int i = SUN_LIGHT_CASCADES - 1; i >= 0; i -- ) {
				vec4 cascade = sunShadowCascade[ cascadeOffset + i ];
				if ( viewDepth >= cascade.x && viewDepth < cascade.y ) {
					float cascadeShadow = getShadow(
						shadowMap,
						sunLightShadow.shadowMapSize,
						sunLightShadow.shadowIntensity,
						sunLightShadow.shadowBias,
						sunLightShadow.shadowRadius,
						sunShadowMatrix[ cascadeOffset + i ] * shadowWorldPosition
					);
					shadow = mix( cascadeShadow, shadow, smoothstep( cascade.z, cascade.y, viewDepth ) );
				}
			}
			return shadow;
		}
	#endif
	#if NUM_POINT_LIGHT_SHADOWS > 0
	#if defined( SHADOWMAP_TYPE_PCF )
	float getPointShadow( samplerCubeShadow shadowMap, vec2 shadowMapSize, float shadowIntensity, float shadowBias, float shadowRadius, vec4 shadowCoord, float shadowCameraNear, float shadowCameraFar ) {
		float shadow = 1.0;
		vec3 lightToPosition = shadowCoord.xyz;
		vec3 bd3D = normalize( lightToPosition );
		vec3 absVec = abs( lightToPosition );
		float viewSpaceZ = max( max( absVec.x, absVec.y ), absVec.z );
		if ( viewSpaceZ - shadowCameraFar <= 0.0 && viewSpaceZ - shadowCameraNear >= 0.0 ) {
			float lightDistance = length( lightToPosition );
			float depthRange = shadowCameraFar - shadowCameraNear;
			#ifdef USE_REVERSED_DEPTH_BUFFER
				float depthA = - shadowCameraNear / depthRange - shadowBias;
				float depthB = shadowCameraNear * shadowCameraFar / ( depthRange * lightDistance );
			#else
				float depthA = shadowCameraFar / depthRange + shadowBias;
				float depthB = - shadowCameraNear * shadowCameraFar / ( depthRange * lightDistance );
			#endif
			float texelSize = shadowRadius / shadowMapSize.x;
			vec3 absDir = abs( bd3D );
			vec3 tangent = absDir.x > absDir.z ? vec3( 0.0, 1.0, 0.0 ) : vec3( 1.0, 0.0, 0.0 );
			tangent = normalize( cross( bd3D, tangent ) );
			vec3 bitangent = cross( bd3D, tangent );
			float phi = interleavedGradientNoise( gl_FragCoord.xy ) * PI2;
			shadow = 0.0;
			for ( int i = 0; i < 5; i ++ ) {
				vec2 offset = vogelDiskSample( i, 5, phi );
				vec3 direction = bd3D + ( tangent * offset.x + bitangent * offset.y ) * texelSize;
				vec3 absDirection = abs( direction );
				float dp = depthA + depthB / max( max( absDirection.x, absDirection.y ), absDirection.z );
				shadow += texture( shadowMap, vec4( direction, dp ) );
			}
			shadow *= 0.2;
		}
		return mix( 1.0, shadow, shadowIntensity );
	}
	#elif defined( SHADOWMAP_TYPE_BASIC )
	float getPointShadow( samplerCube shadowMap, vec2 shadowMapSize, float shadowIntensity, float shadowBias, float shadowRadius, vec4 shadowCoord, float shadowCameraNear, float shadowCameraFar ) {
		float shadow = 1.0;
		vec3 lightToPosition = shadowCoord.xyz;
		vec3 absVec = abs( lightToPosition );
		float viewSpaceZ = max( max( absVec.x, absVec.y ), absVec.z );
		if ( viewSpaceZ - shadowCameraFar <= 0.0 && viewSpaceZ - shadowCameraNear >= 0.0 ) {
			float dp = ( shadowCameraFar * ( viewSpaceZ - shadowCameraNear ) ) / ( viewSpaceZ * ( shadowCameraFar - shadowCameraNear ) );
			dp += shadowBias;
			vec3 bd3D = normalize( lightToPosition );
			float depth = textureCube( shadowMap, bd3D ).r;
			#ifdef USE_REVERSED_DEPTH_BUFFER
				depth = 1.0 - depth;
			#endif
			shadow = step( dp, depth );
		}
		return mix( 1.0, shadow, shadowIntensity );
	}
	#endif
	#endif
#endif`,Qx=`#if NUM_SPOT_LIGHT_COORDS > 0
	uniform mat4 spotLightMatrix[ NUM_SPOT_LIGHT_COORDS ];
	varying vec4 vSpotLightCoord[ NUM_SPOT_LIGHT_COORDS ];
#endif
#ifdef USE_SHADOWMAP
	#if NUM_SUN_LIGHT_SHADOWS > 0
		varying vec4 vSunShadowWorldPosition;
		varying vec3 vSunShadowWorldNormal;
	#endif
	#if NUM_DIR_LIGHT_SHADOWS > 0
		uniform mat4 directionalShadowMatrix[ NUM_DIR_LIGHT_SHADOWS ];
		varying vec4 vDirectionalShadowCoord[ NUM_DIR_LIGHT_SHADOWS ];
		struct DirectionalLightShadow {
			float shadowIntensity;
			float shadowBias;
			float shadowNormalBias;
			float shadowRadius;
			vec2 shadowMapSize;
		};
		uniform DirectionalLightShadow directionalLightShadows[ NUM_DIR_LIGHT_SHADOWS ];
	#endif
	#if NUM_SPOT_LIGHT_SHADOWS > 0
		struct SpotLightShadow {
			float shadowIntensity;
			float shadowBias;
			float shadowNormalBias;
			float shadowRadius;
			vec2 shadowMapSize;
		};
		uniform SpotLightShadow spotLightShadows[ NUM_SPOT_LIGHT_SHADOWS ];
	#endif
	#if NUM_POINT_LIGHT_SHADOWS > 0
		uniform mat4 pointShadowMatrix[ NUM_POINT_LIGHT_SHADOWS ];
		varying vec4 vPointShadowCoord[ NUM_POINT_LIGHT_SHADOWS ];
		struct PointLightShadow {
			float shadowIntensity;
			float shadowBias;
			float shadowNormalBias;
			float shadowRadius;
			vec2 shadowMapSize;
			float shadowCameraNear;
			float shadowCameraFar;
		};
		uniform PointLightShadow pointLightShadows[ NUM_POINT_LIGHT_SHADOWS ];
	#endif
#endif`,ey=`#if ( defined( USE_SHADOWMAP ) && ( NUM_DIR_LIGHT_SHADOWS > 0 || NUM_SUN_LIGHT_SHADOWS > 0 || NUM_POINT_LIGHT_SHADOWS > 0 ) ) || ( NUM_SPOT_LIGHT_COORDS > 0 )
	#ifdef HAS_NORMAL
		vec3 shadowWorldNormal = transformNormalByInverseViewMatrix( transformedNormal, viewMatrix );
	#else
		vec3 shadowWorldNormal = vec3( 0.0 );
	#endif
	vec4 shadowWorldPosition;
#endif
#if defined( USE_SHADOWMAP )
	#if NUM_SUN_LIGHT_SHADOWS > 0
		vSunShadowWorldPosition = vec4( worldPosition.xyz, - mvPosition.z );
		vSunShadowWorldNormal = shadowWorldNormal;
	#endif
	#if NUM_DIR_LIGHT_SHADOWS > 0
		#pragma unroll_loop_start
		for ( int i = 0; i < NUM_DIR_LIGHT_SHADOWS; i ++ ) {
			shadowWorldPosition = worldPosition + vec4( shadowWorldNormal * directionalLightShadows[ i ].shadowNormalBias, 0 );
			vDirectionalShadowCoord[ i ] = directionalShadowMatrix[ i ] * shadowWorldPosition;
		}
		#pragma unroll_loop_end
	#endif
	#if NUM_POINT_LIGHT_SHADOWS > 0
		#pragma unroll_loop_start
		for ( int i = 0; i < NUM_POINT_LIGHT_SHADOWS; i ++ ) {
			shadowWorldPosition = worldPosition + vec4( shadowWorldNormal * pointLightShadows[ i ].shadowNormalBias, 0 );
			vPointShadowCoord[ i ] = pointShadowMatrix[ i ] * shadowWorldPosition;
		}
		#pragma unroll_loop_end
	#endif
#endif
#if NUM_SPOT_LIGHT_COORDS > 0
	#pragma unroll_loop_start
	for ( int i = 0; i < NUM_SPOT_LIGHT_COORDS; i ++ ) {
		shadowWorldPosition = worldPosition;
		#if ( defined( USE_SHADOWMAP ) && UNROLLED_LOOP_INDEX < NUM_SPOT_LIGHT_SHADOWS )
			shadowWorldPosition.xyz += shadowWorldNormal * spotLightShadows[ i ].shadowNormalBias;
		#endif
		vSpotLightCoord[ i ] = spotLightMatrix[ i ] * shadowWorldPosition;
	}
	#pragma unroll_loop_end
#endif`,ty=`float getShadowMask() {
	float shadow = 1.0;
	#ifdef USE_SHADOWMAP
	#if NUM_SUN_LIGHT_SHADOWS > 0
	SunLightShadow sunLight;
	#pragma unroll_loop_start
	for ( int i = 0; i < NUM_SUN_LIGHT_SHADOWS; i ++ ) {
		sunLight = sunLightShadows[ i ];
		shadow *= receiveShadow ? getSunShadow( sunShadowMap[ i ], sunLight, UNROLLED_LOOP_INDEX ) : 1.0;
	}
	#pragma unroll_loop_end
	#endif
	#if NUM_DIR_LIGHT_SHADOWS > 0
	DirectionalLightShadow directionalLight;
	#pragma unroll_loop_start
	for ( int i = 0; i < NUM_DIR_LIGHT_SHADOWS; i ++ ) {
		directionalLight = directionalLightShadows[ i ];
		shadow *= receiveShadow ? getShadow( directionalShadowMap[ i ], directionalLight.shadowMapSize, directionalLight.shadowIntensity, directionalLight.shadowBias, directionalLight.shadowRadius, vDirectionalShadowCoord[ i ] ) : 1.0;
	}
	#pragma unroll_loop_end
	#endif
	#if NUM_SPOT_LIGHT_SHADOWS > 0
	SpotLightShadow spotLight;
	#pragma unroll_loop_start
	for ( int i = 0; i < NUM_SPOT_LIGHT_SHADOWS; i ++ ) {
		spotLight = spotLightShadows[ i ];
		shadow *= receiveShadow ? getShadow( spotShadowMap[ i ], spotLight.shadowMapSize, spotLight.shadowIntensity, spotLight.shadowBias, spotLight.shadowRadius, vSpotLightCoord[ i ] ) : 1.0;
	}
	#pragma unroll_loop_end
	#endif
	#if NUM_POINT_LIGHT_SHADOWS > 0 && ( defined( SHADOWMAP_TYPE_PCF ) || defined( SHADOWMAP_TYPE_BASIC ) )
	PointLightShadow pointLight;
	#pragma unroll_loop_start
	for ( int i = 0; i < NUM_POINT_LIGHT_SHADOWS; i ++ ) {
		pointLight = pointLightShadows[ i ];
		shadow *= receiveShadow ? getPointShadow( pointShadowMap[ i ], pointLight.shadowMapSize, pointLight.shadowIntensity, pointLight.shadowBias, pointLight.shadowRadius, vPointShadowCoord[ i ], pointLight.shadowCameraNear, pointLight.shadowCameraFar ) : 1.0;
	}
	#pragma unroll_loop_end
	#endif
	#endif
	return shadow;
}`,ny=`#ifdef USE_SKINNING
	mat4 boneMatX = getBoneMatrix( skinIndex.x );
	mat4 boneMatY = getBoneMatrix( skinIndex.y );
	mat4 boneMatZ = getBoneMatrix( skinIndex.z );
	mat4 boneMatW = getBoneMatrix( skinIndex.w );
#endif`,iy=`#ifdef USE_SKINNING
	uniform mat4 bindMatrix;
	uniform mat4 bindMatrixInverse;
	uniform highp sampler2D boneTexture;
	mat4 getBoneMatrix( const in float i ) {
		int size = textureSize( boneTexture, 0 ).x;
		int j = int( i ) * 4;
		int x = j % size;
		int y = j / size;
		vec4 v1 = texelFetch( boneTexture, ivec2( x, y ), 0 );
		vec4 v2 = texelFetch( boneTexture, ivec2( x + 1, y ), 0 );
		vec4 v3 = texelFetch( boneTexture, ivec2( x + 2, y ), 0 );
		vec4 v4 = texelFetch( boneTexture, ivec2( x + 3, y ), 0 );
		return mat4( v1, v2, v3, v4 );
	}
#endif`,sy=`#ifdef USE_SKINNING
	vec4 skinVertex = bindMatrix * vec4( transformed, 1.0 );
	vec4 skinned = vec4( 0.0 );
	skinned += boneMatX * skinVertex * skinWeight.x;
	skinned += boneMatY * skinVertex * skinWeight.y;
	skinned += boneMatZ * skinVertex * skinWeight.z;
	skinned += boneMatW * skinVertex * skinWeight.w;
	transformed = ( bindMatrixInverse * skinned ).xyz;
#endif`,ry=`#ifdef USE_SKINNING
	mat4 skinMatrix = mat4( 0.0 );
	skinMatrix += skinWeight.x * boneMatX;
	skinMatrix += skinWeight.y * boneMatY;
	skinMatrix += skinWeight.z * boneMatZ;
	skinMatrix += skinWeight.w * boneMatW;
	skinMatrix = bindMatrixInverse * skinMatrix * bindMatrix;
	objectNormal = vec4( skinMatrix * vec4( objectNormal, 0.0 ) ).xyz;
	#ifdef USE_TANGENT
		objectTangent = vec4( skinMatrix * vec4( objectTangent, 0.0 ) ).xyz;
	#endif
#endif`,oy=`float specularStrength;
#ifdef USE_SPECULARMAP
	vec4 texelSpecular = texture2D( specularMap, vSpecularMapUv );
	specularStrength = texelSpecular.r;
#else
	specularStrength = 1.0;
#endif`,ay=`#ifdef USE_SPECULARMAP
	uniform sampler2D specularMap;
#endif`,ly=`#if defined( TONE_MAPPING )
	gl_FragColor.rgb = toneMapping( gl_FragColor.rgb );
#endif`,cy=`#ifndef saturate
#define saturate( a ) clamp( a, 0.0, 1.0 )
#endif
uniform float toneMappingExposure;
vec3 LinearToneMapping( vec3 color ) {
	return saturate( toneMappingExposure * color );
}
vec3 ReinhardToneMapping( vec3 color ) {
	color *= toneMappingExposure;
	return saturate( color / ( vec3( 1.0 ) + color ) );
}
vec3 CineonToneMapping( vec3 color ) {
	color *= toneMappingExposure;
	color = max( vec3( 0.0 ), color - 0.004 );
	return pow( ( color * ( 6.2 * color + 0.5 ) ) / ( color * ( 6.2 * color + 1.7 ) + 0.06 ), vec3( 2.2 ) );
}
vec3 RRTAndODTFit( vec3 v ) {
	vec3 a = v * ( v + 0.0245786 ) - 0.000090537;
	vec3 b = v * ( 0.983729 * v + 0.4329510 ) + 0.238081;
	return a / b;
}
vec3 ACESFilmicToneMapping( vec3 color ) {
	const mat3 ACESInputMat = mat3(
		vec3( 0.59719, 0.07600, 0.02840 ),		vec3( 0.35458, 0.90834, 0.13383 ),
		vec3( 0.04823, 0.01566, 0.83777 )
	);
	const mat3 ACESOutputMat = mat3(
		vec3(  1.60475, -0.10208, -0.00327 ),		vec3( -0.53108,  1.10813, -0.07276 ),
		vec3( -0.07367, -0.00605,  1.07602 )
	);
	color *= toneMappingExposure / 0.6;
	color = ACESInputMat * color;
	color = RRTAndODTFit( color );
	color = ACESOutputMat * color;
	return saturate( color );
}
const mat3 LINEAR_REC2020_TO_LINEAR_SRGB = mat3(
	vec3( 1.6605, - 0.1246, - 0.0182 ),
	vec3( - 0.5876, 1.1329, - 0.1006 ),
	vec3( - 0.0728, - 0.0083, 1.1187 )
);
const mat3 LINEAR_SRGB_TO_LINEAR_REC2020 = mat3(
	vec3( 0.6274, 0.0691, 0.0164 ),
	vec3( 0.3293, 0.9195, 0.0880 ),
	vec3( 0.0433, 0.0113, 0.8956 )
);
vec3 agxDefaultContrastApprox( vec3 x ) {
	vec3 x2 = x * x;
	vec3 x4 = x2 * x2;
	return + 15.5 * x4 * x2
		- 40.14 * x4 * x
		+ 31.96 * x4
		- 6.868 * x2 * x
		+ 0.4298 * x2
		+ 0.1191 * x
		- 0.00232;
}
vec3 AgXToneMapping( vec3 color ) {
	const mat3 AgXInsetMatrix = mat3(
		vec3( 0.856627153315983, 0.137318972929847, 0.11189821299995 ),
		vec3( 0.0951212405381588, 0.761241990602591, 0.0767994186031903 ),
		vec3( 0.0482516061458583, 0.101439036467562, 0.811302368396859 )
	);
	const mat3 AgXOutsetMatrix = mat3(
		vec3( 1.1271005818144368, - 0.1413297634984383, - 0.14132976349843826 ),
		vec3( - 0.11060664309660323, 1.157823702216272, - 0.11060664309660294 ),
		vec3( - 0.016493938717834573, - 0.016493938717834257, 1.2519364065950405 )
	);
	const float AgxMinEv = - 12.47393;	const float AgxMaxEv = 4.026069;
	color *= toneMappingExposure;
	color = LINEAR_SRGB_TO_LINEAR_REC2020 * color;
	color = AgXInsetMatrix * color;
	color = max( color, 1e-10 );	color = log2( color );
	color = ( color - AgxMinEv ) / ( AgxMaxEv - AgxMinEv );
	color = clamp( color, 0.0, 1.0 );
	color = agxDefaultContrastApprox( color );
	color = AgXOutsetMatrix * color;
	color = pow( max( vec3( 0.0 ), color ), vec3( 2.2 ) );
	color = LINEAR_REC2020_TO_LINEAR_SRGB * color;
	color = clamp( color, 0.0, 1.0 );
	return color;
}
vec3 NeutralToneMapping( vec3 color ) {
	const float StartCompression = 0.8 - 0.04;
	const float Desaturation = 0.15;
	color *= toneMappingExposure;
	float x = min( color.r, min( color.g, color.b ) );
	float offset = x < 0.08 ? x - 6.25 * x * x : 0.04;
	color -= offset;
	float peak = max( color.r, max( color.g, color.b ) );
	if ( peak < StartCompression ) return color;
	float d = 1. - StartCompression;
	float newPeak = 1. - d * d / ( peak + d - StartCompression );
	color *= newPeak / peak;
	float g = 1. - 1. / ( Desaturation * ( peak - newPeak ) + 1. );
	return mix( color, vec3( newPeak ), g );
}
vec3 CustomToneMapping( vec3 color ) { return color; }`,hy=`#ifdef USE_TRANSMISSION
	material.transmission = transmission;
	material.transmissionAlpha = 1.0;
	material.thickness = thickness;
	material.attenuationDistance = attenuationDistance;
	material.attenuationColor = attenuationColor;
	#ifdef USE_TRANSMISSIONMAP
		material.transmission *= texture2D( transmissionMap, vTransmissionMapUv ).r;
	#endif
	#ifdef USE_THICKNESSMAP
		material.thickness *= texture2D( thicknessMap, vThicknessMapUv ).g;
	#endif
	vec3 pos = vWorldPosition;
	vec3 v = normalize( cameraPosition - pos );
	vec3 n = transformNormalByInverseViewMatrix( normal, viewMatrix );
	vec4 transmitted = getIBLVolumeRefraction(
		n, v, material.roughness, material.diffuseContribution, material.specularColorBlended, material.specularF90,
		pos, modelMatrix, viewMatrix, projectionMatrix, material.dispersion, material.ior, material.thickness,
		material.attenuationColor, material.attenuationDistance );
	material.transmissionAlpha = mix( material.transmissionAlpha, transmitted.a, material.transmission );
	totalDiffuse = mix( totalDiffuse, transmitted.rgb, material.transmission );
#endif`,uy=`#ifdef USE_TRANSMISSION
	uniform float transmission;
	uniform float thickness;
	uniform float attenuationDistance;
	uniform vec3 attenuationColor;
	#ifdef USE_TRANSMISSIONMAP
		uniform sampler2D transmissionMap;
	#endif
	#ifdef USE_THICKNESSMAP
		uniform sampler2D thicknessMap;
	#endif
	uniform vec2 transmissionSamplerSize;
	uniform sampler2D transmissionSamplerMap;
	uniform mat4 modelMatrix;
	uniform mat4 projectionMatrix;
	varying vec3 vWorldPosition;
	float w0( float a ) {
		return ( 1.0 / 6.0 ) * ( a * ( a * ( - a + 3.0 ) - 3.0 ) + 1.0 );
	}
	float w1( float a ) {
		return ( 1.0 / 6.0 ) * ( a *  a * ( 3.0 * a - 6.0 ) + 4.0 );
	}
	float w2( float a ){
		return ( 1.0 / 6.0 ) * ( a * ( a * ( - 3.0 * a + 3.0 ) + 3.0 ) + 1.0 );
	}
	float w3( float a ) {
		return ( 1.0 / 6.0 ) * ( a * a * a );
	}
	float g0( float a ) {
		return w0( a ) + w1( a );
	}
	float g1( float a ) {
		return w2( a ) + w3( a );
	}
	float h0( float a ) {
		return - 1.0 + w1( a ) / ( w0( a ) + w1( a ) );
	}
	float h1( float a ) {
		return 1.0 + w3( a ) / ( w2( a ) + w3( a ) );
	}
	vec4 bicubic( sampler2D tex, vec2 uv, vec4 texelSize, float lod ) {
		uv = uv * texelSize.zw + 0.5;
		vec2 iuv = floor( uv );
		vec2 fuv = fract( uv );
		float g0x = g0( fuv.x );
		float g1x = g1( fuv.x );
		float h0x = h0( fuv.x );
		float h1x = h1( fuv.x );
		float h0y = h0( fuv.y );
		float h1y = h1( fuv.y );
		vec2 p0 = ( vec2( iuv.x + h0x, iuv.y + h0y ) - 0.5 ) * texelSize.xy;
		vec2 p1 = ( vec2( iuv.x + h1x, iuv.y + h0y ) - 0.5 ) * texelSize.xy;
		vec2 p2 = ( vec2( iuv.x + h0x, iuv.y + h1y ) - 0.5 ) * texelSize.xy;
		vec2 p3 = ( vec2( iuv.x + h1x, iuv.y + h1y ) - 0.5 ) * texelSize.xy;
		return g0( fuv.y ) * ( g0x * textureLod( tex, p0, lod ) + g1x * textureLod( tex, p1, lod ) ) +
			g1( fuv.y ) * ( g0x * textureLod( tex, p2, lod ) + g1x * textureLod( tex, p3, lod ) );
	}
	vec4 textureBicubic( sampler2D sampler, vec2 uv, float lod ) {
		vec2 fLodSize = vec2( textureSize( sampler, int( lod ) ) );
		vec2 cLodSize = vec2( textureSize( sampler, int( lod + 1.0 ) ) );
		vec2 fLodSizeInv = 1.0 / fLodSize;
		vec2 cLodSizeInv = 1.0 / cLodSize;
		vec4 fSample = bicubic( sampler, uv, vec4( fLodSizeInv, fLodSize ), floor( lod ) );
		vec4 cSample = bicubic( sampler, uv, vec4( cLodSizeInv, cLodSize ), ceil( lod ) );
		return mix( fSample, cSample, fract( lod ) );
	}
	vec3 getVolumeTransmissionRay( const in vec3 n, const in vec3 v, const in float thickness, const in float ior, const in mat4 modelMatrix ) {
		vec3 refractionVector = refract( - v, normalize( n ), 1.0 / ior );
		vec3 modelScale;
		modelScale.x = length( vec3( modelMatrix[ 0 ].xyz ) );
		modelScale.y = length( vec3( modelMatrix[ 1 ].xyz ) );
		modelScale.z = length( vec3( modelMatrix[ 2 ].xyz ) );
		return normalize( refractionVector ) * thickness * modelScale;
	}
	float applyIorToRoughness( const in float roughness, const in float ior ) {
		return roughness * clamp( ior * 2.0 - 2.0, 0.0, 1.0 );
	}
	vec4 getTransmissionSample( const in vec2 fragCoord, const in float roughness, const in float ior ) {
		float lod = log2( transmissionSamplerSize.x ) * applyIorToRoughness( roughness, ior );
		return textureBicubic( transmissionSamplerMap, fragCoord.xy, lod );
	}
	vec3 volumeAttenuation( const in float transmissionDistance, const in vec3 attenuationColor, const in float attenuationDistance ) {
		if ( isinf( attenuationDistance ) ) {
			return vec3( 1.0 );
		} else {
			vec3 attenuationCoefficient = -log( attenuationColor ) / attenuationDistance;
			vec3 transmittance = exp( - attenuationCoefficient * transmissionDistance );			return transmittance;
		}
	}
	vec4 getIBLVolumeRefraction( const in vec3 n, const in vec3 v, const in float roughness, const in vec3 diffuseColor,
		const in vec3 specularColor, const in float specularF90, const in vec3 position, const in mat4 modelMatrix,
		const in mat4 viewMatrix, const in mat4 projMatrix, const in float dispersion, const in float ior, const in float thickness,
		const in vec3 attenuationColor, const in float attenuationDistance ) {
		vec4 transmittedLight;
		vec3 transmittance;
		#ifdef USE_DISPERSION
			float halfSpread = ( ior - 1.0 ) * 0.025 * dispersion;
			vec3 iors = vec3( ior - halfSpread, ior, ior + halfSpread );
			for ( int i = 0; i < 3; i ++ ) {
				vec3 transmissionRay = getVolumeTransmissionRay( n, v, thickness, iors[ i ], modelMatrix );
				vec3 refractedRayExit = position + transmissionRay;
				vec4 ndcPos = projMatrix * viewMatrix * vec4( refractedRayExit, 1.0 );
				vec2 refractionCoords = ndcPos.xy / ndcPos.w;
				refractionCoords += 1.0;
				refractionCoords /= 2.0;
				vec4 transmissionSample = getTransmissionSample( refractionCoords, roughness, iors[ i ] );
				transmittedLight[ i ] = transmissionSample[ i ];
				transmittedLight.a += transmissionSample.a;
				transmittance[ i ] = diffuseColor[ i ] * volumeAttenuation( length( transmissionRay ), attenuationColor, attenuationDistance )[ i ];
			}
			transmittedLight.a /= 3.0;
		#else
			vec3 transmissionRay = getVolumeTransmissionRay( n, v, thickness, ior, modelMatrix );
			vec3 refractedRayExit = position + transmissionRay;
			vec4 ndcPos = projMatrix * viewMatrix * vec4( refractedRayExit, 1.0 );
			vec2 refractionCoords = ndcPos.xy / ndcPos.w;
			refractionCoords += 1.0;
			refractionCoords /= 2.0;
			transmittedLight = getTransmissionSample( refractionCoords, roughness, ior );
			transmittance = diffuseColor * volumeAttenuation( length( transmissionRay ), attenuationColor, attenuationDistance );
		#endif
		vec3 attenuatedColor = transmittance * transmittedLight.rgb;
		vec3 F = EnvironmentBRDF( n, v, specularColor, specularF90, roughness );
		float transmittanceFactor = ( transmittance.r + transmittance.g + transmittance.b ) / 3.0;
		return vec4( ( 1.0 - F ) * attenuatedColor, 1.0 - ( 1.0 - transmittedLight.a ) * transmittanceFactor );
	}
#endif`,dy=`#if defined( USE_UV ) || defined( USE_ANISOTROPY )
	varying vec2 vUv;
#endif
#ifdef USE_MAP
	varying vec2 vMapUv;
#endif
#ifdef USE_ALPHAMAP
	varying vec2 vAlphaMapUv;
#endif
#ifdef USE_LIGHTMAP
	varying vec2 vLightMapUv;
#endif
#ifdef USE_AOMAP
	varying vec2 vAoMapUv;
#endif
#ifdef USE_BUMPMAP
	varying vec2 vBumpMapUv;
#endif
#ifdef USE_NORMALMAP
	varying vec2 vNormalMapUv;
#endif
#ifdef USE_EMISSIVEMAP
	varying vec2 vEmissiveMapUv;
#endif
#ifdef USE_METALNESSMAP
	varying vec2 vMetalnessMapUv;
#endif
#ifdef USE_ROUGHNESSMAP
	varying vec2 vRoughnessMapUv;
#endif
#ifdef USE_DIFFUSE_ROUGHNESSMAP
	varying vec2 vDiffuseRoughnessMapUv;
#endif
#ifdef USE_ANISOTROPYMAP
	varying vec2 vAnisotropyMapUv;
#endif
#ifdef USE_CLEARCOATMAP
	varying vec2 vClearcoatMapUv;
#endif
#ifdef USE_CLEARCOAT_NORMALMAP
	varying vec2 vClearcoatNormalMapUv;
#endif
#ifdef USE_CLEARCOAT_ROUGHNESSMAP
	varying vec2 vClearcoatRoughnessMapUv;
#endif
#ifdef USE_IRIDESCENCEMAP
	varying vec2 vIridescenceMapUv;
#endif
#ifdef USE_IRIDESCENCE_THICKNESSMAP
	varying vec2 vIridescenceThicknessMapUv;
#endif
#ifdef USE_SHEEN_COLORMAP
	varying vec2 vSheenColorMapUv;
#endif
#ifdef USE_SHEEN_ROUGHNESSMAP
	varying vec2 vSheenRoughnessMapUv;
#endif
#ifdef USE_SPECULARMAP
	varying vec2 vSpecularMapUv;
#endif
#ifdef USE_SPECULAR_COLORMAP
	varying vec2 vSpecularColorMapUv;
#endif
#ifdef USE_SPECULAR_INTENSITYMAP
	varying vec2 vSpecularIntensityMapUv;
#endif
#ifdef USE_TRANSMISSIONMAP
	uniform mat3 transmissionMapTransform;
	varying vec2 vTransmissionMapUv;
#endif
#ifdef USE_THICKNESSMAP
	uniform mat3 thicknessMapTransform;
	varying vec2 vThicknessMapUv;
#endif`,fy=`#if defined( USE_UV ) || defined( USE_ANISOTROPY )
	varying vec2 vUv;
#endif
#ifdef USE_MAP
	uniform mat3 mapTransform;
	varying vec2 vMapUv;
#endif
#ifdef USE_ALPHAMAP
	uniform mat3 alphaMapTransform;
	varying vec2 vAlphaMapUv;
#endif
#ifdef USE_LIGHTMAP
	uniform mat3 lightMapTransform;
	varying vec2 vLightMapUv;
#endif
#ifdef USE_AOMAP
	uniform mat3 aoMapTransform;
	varying vec2 vAoMapUv;
#endif
#ifdef USE_BUMPMAP
	uniform mat3 bumpMapTransform;
	varying vec2 vBumpMapUv;
#endif
#ifdef USE_NORMALMAP
	uniform mat3 normalMapTransform;
	varying vec2 vNormalMapUv;
#endif
#ifdef USE_DISPLACEMENTMAP
	uniform mat3 displacementMapTransform;
	varying vec2 vDisplacementMapUv;
#endif
#ifdef USE_EMISSIVEMAP
	uniform mat3 emissiveMapTransform;
	varying vec2 vEmissiveMapUv;
#endif
#ifdef USE_METALNESSMAP
	uniform mat3 metalnessMapTransform;
	varying vec2 vMetalnessMapUv;
#endif
#ifdef USE_ROUGHNESSMAP
	uniform mat3 roughnessMapTransform;
	varying vec2 vRoughnessMapUv;
#endif
#ifdef USE_DIFFUSE_ROUGHNESSMAP
	uniform mat3 diffuseRoughnessMapTransform;
	varying vec2 vDiffuseRoughnessMapUv;
#endif
#ifdef USE_ANISOTROPYMAP
	uniform mat3 anisotropyMapTransform;
	varying vec2 vAnisotropyMapUv;
#endif
#ifdef USE_CLEARCOATMAP
	uniform mat3 clearcoatMapTransform;
	varying vec2 vClearcoatMapUv;
#endif
#ifdef USE_CLEARCOAT_NORMALMAP
	uniform mat3 clearcoatNormalMapTransform;
	varying vec2 vClearcoatNormalMapUv;
#endif
#ifdef USE_CLEARCOAT_ROUGHNESSMAP
	uniform mat3 clearcoatRoughnessMapTransform;
	varying vec2 vClearcoatRoughnessMapUv;
#endif
#ifdef USE_SHEEN_COLORMAP
	uniform mat3 sheenColorMapTransform;
	varying vec2 vSheenColorMapUv;
#endif
#ifdef USE_SHEEN_ROUGHNESSMAP
	uniform mat3 sheenRoughnessMapTransform;
	varying vec2 vSheenRoughnessMapUv;
#endif
#ifdef USE_IRIDESCENCEMAP
	uniform mat3 iridescenceMapTransform;
	varying vec2 vIridescenceMapUv;
#endif
#ifdef USE_IRIDESCENCE_THICKNESSMAP
	uniform mat3 iridescenceThicknessMapTransform;
	varying vec2 vIridescenceThicknessMapUv;
#endif
#ifdef USE_SPECULARMAP
	uniform mat3 specularMapTransform;
	varying vec2 vSpecularMapUv;
#endif
#ifdef USE_SPECULAR_COLORMAP
	uniform mat3 specularColorMapTransform;
	varying vec2 vSpecularColorMapUv;
#endif
#ifdef USE_SPECULAR_INTENSITYMAP
	uniform mat3 specularIntensityMapTransform;
	varying vec2 vSpecularIntensityMapUv;
#endif
#ifdef USE_TRANSMISSIONMAP
	uniform mat3 transmissionMapTransform;
	varying vec2 vTransmissionMapUv;
#endif
#ifdef USE_THICKNESSMAP
	uniform mat3 thicknessMapTransform;
	varying vec2 vThicknessMapUv;
#endif`,py=`#if defined( USE_UV ) || defined( USE_ANISOTROPY )
	vUv = vec3( uv, 1 ).xy;
#endif
#ifdef USE_MAP
	vMapUv = ( mapTransform * vec3( MAP_UV, 1 ) ).xy;
#endif
#ifdef USE_ALPHAMAP
	vAlphaMapUv = ( alphaMapTransform * vec3( ALPHAMAP_UV, 1 ) ).xy;
#endif
#ifdef USE_LIGHTMAP
	vLightMapUv = ( lightMapTransform * vec3( LIGHTMAP_UV, 1 ) ).xy;
#endif
#ifdef USE_AOMAP
	vAoMapUv = ( aoMapTransform * vec3( AOMAP_UV, 1 ) ).xy;
#endif
#ifdef USE_BUMPMAP
	vBumpMapUv = ( bumpMapTransform * vec3( BUMPMAP_UV, 1 ) ).xy;
#endif
#ifdef USE_NORMALMAP
	vNormalMapUv = ( normalMapTransform * vec3( NORMALMAP_UV, 1 ) ).xy;
#endif
#ifdef USE_DISPLACEMENTMAP
	vDisplacementMapUv = ( displacementMapTransform * vec3( DISPLACEMENTMAP_UV, 1 ) ).xy;
#endif
#ifdef USE_EMISSIVEMAP
	vEmissiveMapUv = ( emissiveMapTransform * vec3( EMISSIVEMAP_UV, 1 ) ).xy;
#endif
#ifdef USE_METALNESSMAP
	vMetalnessMapUv = ( metalnessMapTransform * vec3( METALNESSMAP_UV, 1 ) ).xy;
#endif
#ifdef USE_ROUGHNESSMAP
	vRoughnessMapUv = ( roughnessMapTransform * vec3( ROUGHNESSMAP_UV, 1 ) ).xy;
#endif
#ifdef USE_DIFFUSE_ROUGHNESSMAP
	vDiffuseRoughnessMapUv = ( diffuseRoughnessMapTransform * vec3( DIFFUSE_ROUGHNESSMAP_UV, 1 ) ).xy;
#endif
#ifdef USE_ANISOTROPYMAP
	vAnisotropyMapUv = ( anisotropyMapTransform * vec3( ANISOTROPYMAP_UV, 1 ) ).xy;
#endif
#ifdef USE_CLEARCOATMAP
	vClearcoatMapUv = ( clearcoatMapTransform * vec3( CLEARCOATMAP_UV, 1 ) ).xy;
#endif
#ifdef USE_CLEARCOAT_NORMALMAP
	vClearcoatNormalMapUv = ( clearcoatNormalMapTransform * vec3( CLEARCOAT_NORMALMAP_UV, 1 ) ).xy;
#endif
#ifdef USE_CLEARCOAT_ROUGHNESSMAP
	vClearcoatRoughnessMapUv = ( clearcoatRoughnessMapTransform * vec3( CLEARCOAT_ROUGHNESSMAP_UV, 1 ) ).xy;
#endif
#ifdef USE_IRIDESCENCEMAP
	vIridescenceMapUv = ( iridescenceMapTransform * vec3( IRIDESCENCEMAP_UV, 1 ) ).xy;
#endif
#ifdef USE_IRIDESCENCE_THICKNESSMAP
	vIridescenceThicknessMapUv = ( iridescenceThicknessMapTransform * vec3( IRIDESCENCE_THICKNESSMAP_UV, 1 ) ).xy;
#endif
#ifdef USE_SHEEN_COLORMAP
	vSheenColorMapUv = ( sheenColorMapTransform * vec3( SHEEN_COLORMAP_UV, 1 ) ).xy;
#endif
#ifdef USE_SHEEN_ROUGHNESSMAP
	vSheenRoughnessMapUv = ( sheenRoughnessMapTransform * vec3( SHEEN_ROUGHNESSMAP_UV, 1 ) ).xy;
#endif
#ifdef USE_SPECULARMAP
	vSpecularMapUv = ( specularMapTransform * vec3( SPECULARMAP_UV, 1 ) ).xy;
#endif
#ifdef USE_SPECULAR_COLORMAP
	vSpecularColorMapUv = ( specularColorMapTransform * vec3( SPECULAR_COLORMAP_UV, 1 ) ).xy;
#endif
#ifdef USE_SPECULAR_INTENSITYMAP
	vSpecularIntensityMapUv = ( specularIntensityMapTransform * vec3( SPECULAR_INTENSITYMAP_UV, 1 ) ).xy;
#endif
#ifdef USE_TRANSMISSIONMAP
	vTransmissionMapUv = ( transmissionMapTransform * vec3( TRANSMISSIONMAP_UV, 1 ) ).xy;
#endif
#ifdef USE_THICKNESSMAP
	vThicknessMapUv = ( thicknessMapTransform * vec3( THICKNESSMAP_UV, 1 ) ).xy;
#endif`,my=`#if defined( USE_ENVMAP ) || defined( DISTANCE ) || defined ( USE_SHADOWMAP ) || defined ( USE_TRANSMISSION ) || NUM_SPOT_LIGHT_COORDS > 0
	vec4 worldPosition = vec4( transformed, 1.0 );
	#ifdef USE_BATCHING
		worldPosition = batchingMatrix * worldPosition;
	#endif
	#ifdef USE_INSTANCING
		worldPosition = instanceMatrix * worldPosition;
	#endif
	worldPosition = modelMatrix * worldPosition;
#endif`,gy=`varying vec2 vUv;
uniform mat3 uvTransform;
void main() {
	vUv = ( uvTransform * vec3( uv, 1 ) ).xy;
	gl_Position = vec4( position.xy, 1.0, 1.0 );
}`,vy=`uniform sampler2D t2D;
uniform float backgroundIntensity;
varying vec2 vUv;
void main() {
	vec4 texColor = texture2D( t2D, vUv );
	#ifdef DECODE_VIDEO_TEXTURE
		texColor = vec4( mix( pow( texColor.rgb * 0.9478672986 + vec3( 0.0521327014 ), vec3( 2.4 ) ), texColor.rgb * 0.0773993808, vec3( lessThanEqual( texColor.rgb, vec3( 0.04045 ) ) ) ), texColor.w );
	#endif
	texColor.rgb *= backgroundIntensity;
	gl_FragColor = texColor;
	#include <tonemapping_fragment>
	#include <colorspace_fragment>
}`,_y=`varying vec3 vWorldDirection;
#include <common>
void main() {
	vWorldDirection = transformDirection( position, modelMatrix );
	#include <begin_vertex>
	#include <project_vertex>
	gl_Position.z = gl_Position.w;
}`,xy=`uniform float backgroundBlurriness;
uniform float backgroundIntensity;
uniform mat3 backgroundRotation;
varying vec3 vWorldDirection;
#include <envmap_common_pars_fragment>
void main() {
	#ifdef ENVMAP_TYPE_PMREM
		vec4 texColor = textureLod( envMap, backgroundRotation * vWorldDirection, roughnessToMip( backgroundBlurriness ) );
	#else
		vec4 texColor = textureCube( envMap, backgroundRotation * vWorldDirection );
	#endif
	texColor.rgb *= backgroundIntensity;
	gl_FragColor = texColor;
	#include <tonemapping_fragment>
	#include <colorspace_fragment>
}`,yy=`varying vec3 vWorldDirection;
#include <common>
void main() {
	vWorldDirection = transformDirection( position, modelMatrix );
	#include <begin_vertex>
	#include <project_vertex>
	gl_Position.z = gl_Position.w;
}`,by=`uniform samplerCube tCube;
uniform float tFlip;
uniform float opacity;
varying vec3 vWorldDirection;
void main() {
	vec4 texColor = textureCube( tCube, vec3( tFlip * vWorldDirection.x, vWorldDirection.yz ) );
	gl_FragColor = texColor;
	gl_FragColor.a *= opacity;
	#include <tonemapping_fragment>
	#include <colorspace_fragment>
}`,Sy=`#include <common>
#include <batching_pars_vertex>
#include <uv_pars_vertex>
#include <displacementmap_pars_vertex>
#include <morphtarget_pars_vertex>
#include <skinning_pars_vertex>
#include <logdepthbuf_pars_vertex>
#include <clipping_planes_pars_vertex>
varying vec2 vHighPrecisionZW;
void main() {
	#include <uv_vertex>
	#include <batching_vertex>
	#include <skinbase_vertex>
	#include <morphinstance_vertex>
	#ifdef USE_DISPLACEMENTMAP
		#include <beginnormal_vertex>
		#include <morphnormal_vertex>
		#include <skinnormal_vertex>
	#endif
	#include <begin_vertex>
	#include <morphtarget_vertex>
	#include <skinning_vertex>
	#include <displacementmap_vertex>
	#include <project_vertex>
	#include <logdepthbuf_vertex>
	#include <clipping_planes_vertex>
	vHighPrecisionZW = gl_Position.zw;
}`,My=`#if DEPTH_PACKING == 3200
	uniform float opacity;
#endif
#include <common>
#include <packing>
#include <uv_pars_fragment>
#include <map_pars_fragment>
#include <alphamap_pars_fragment>
#include <alphatest_pars_fragment>
#include <alphahash_pars_fragment>
#include <logdepthbuf_pars_fragment>
#include <clipping_planes_pars_fragment>
varying vec2 vHighPrecisionZW;
void main() {
	vec4 diffuseColor = vec4( 1.0 );
	#include <clipping_planes_fragment>
	#if DEPTH_PACKING == 3200
		diffuseColor.a = opacity;
	#endif
	#include <map_fragment>
	#include <alphamap_fragment>
	#include <alphatest_fragment>
	#include <alphahash_fragment>
	#include <logdepthbuf_fragment>
	#ifdef USE_REVERSED_DEPTH_BUFFER
		float fragCoordZ = vHighPrecisionZW[ 0 ] / vHighPrecisionZW[ 1 ];
	#else
		float fragCoordZ = 0.5 * vHighPrecisionZW[ 0 ] / vHighPrecisionZW[ 1 ] + 0.5;
	#endif
	#if DEPTH_PACKING == 3200
		gl_FragColor = vec4( vec3( 1.0 - fragCoordZ ), opacity );
	#elif DEPTH_PACKING == 3201
		gl_FragColor = packDepthToRGBA( fragCoordZ );
	#elif DEPTH_PACKING == 3202
		gl_FragColor = vec4( packDepthToRGB( fragCoordZ ), 1.0 );
	#elif DEPTH_PACKING == 3203
		gl_FragColor = vec4( packDepthToRG( fragCoordZ ), 0.0, 1.0 );
	#endif
}`,wy=`#define DISTANCE
varying vec3 vWorldPosition;
#include <common>
#include <batching_pars_vertex>
#include <uv_pars_vertex>
#include <displacementmap_pars_vertex>
#include <morphtarget_pars_vertex>
#include <skinning_pars_vertex>
#include <clipping_planes_pars_vertex>
void main() {
	#include <uv_vertex>
	#include <batching_vertex>
	#include <skinbase_vertex>
	#include <morphinstance_vertex>
	#ifdef USE_DISPLACEMENTMAP
		#include <beginnormal_vertex>
		#include <morphnormal_vertex>
		#include <skinnormal_vertex>
	#endif
	#include <begin_vertex>
	#include <morphtarget_vertex>
	#include <skinning_vertex>
	#include <displacementmap_vertex>
	#include <project_vertex>
	#include <worldpos_vertex>
	#include <clipping_planes_vertex>
	vWorldPosition = worldPosition.xyz;
}`,Ey=`#define DISTANCE
uniform vec3 referencePosition;
uniform float nearDistance;
uniform float farDistance;
varying vec3 vWorldPosition;
#include <common>
#include <uv_pars_fragment>
#include <map_pars_fragment>
#include <alphamap_pars_fragment>
#include <alphatest_pars_fragment>
#include <alphahash_pars_fragment>
#include <clipping_planes_pars_fragment>
void main() {
	vec4 diffuseColor = vec4( 1.0 );
	#include <clipping_planes_fragment>
	#include <map_fragment>
	#include <alphamap_fragment>
	#include <alphatest_fragment>
	#include <alphahash_fragment>
	float dist = length( vWorldPosition - referencePosition );
	dist = ( dist - nearDistance ) / ( farDistance - nearDistance );
	dist = saturate( dist );
	gl_FragColor = vec4( dist, 0.0, 0.0, 1.0 );
}`,Ty=`varying vec3 vWorldDirection;
#include <common>
void main() {
	vWorldDirection = transformDirection( position, modelMatrix );
	#include <begin_vertex>
	#include <project_vertex>
}`,Ay=`uniform sampler2D tEquirect;
varying vec3 vWorldDirection;
#include <common>
void main() {
	vec3 direction = normalize( vWorldDirection );
	vec2 sampleUV = equirectUv( direction );
	gl_FragColor = texture2D( tEquirect, sampleUV );
	#include <tonemapping_fragment>
	#include <colorspace_fragment>
}`,Ry=`uniform float scale;
attribute float lineDistance;
varying float vLineDistance;
#include <common>
#include <uv_pars_vertex>
#include <color_pars_vertex>
#include <fog_pars_vertex>
#include <morphtarget_pars_vertex>
#include <logdepthbuf_pars_vertex>
#include <clipping_planes_pars_vertex>
void main() {
	vLineDistance = scale * lineDistance;
	#include <uv_vertex>
	#include <color_vertex>
	#include <morphinstance_vertex>
	#include <morphcolor_vertex>
	#include <begin_vertex>
	#include <morphtarget_vertex>
	#include <project_vertex>
	#include <logdepthbuf_vertex>
	#include <clipping_planes_vertex>
	#include <fog_vertex>
}`,Cy=`uniform vec3 diffuse;
uniform float opacity;
uniform float dashSize;
uniform float totalSize;
varying float vLineDistance;
#include <common>
#include <color_pars_fragment>
#include <uv_pars_fragment>
#include <map_pars_fragment>
#include <fog_pars_fragment>
#include <logdepthbuf_pars_fragment>
#include <clipping_planes_pars_fragment>
void main() {
	vec4 diffuseColor = vec4( diffuse, opacity );
	#include <clipping_planes_fragment>
	if ( mod( vLineDistance, totalSize ) > dashSize ) {
		discard;
	}
	vec3 outgoingLight = vec3( 0.0 );
	#include <logdepthbuf_fragment>
	#include <map_fragment>
	#include <color_fragment>
	outgoingLight = diffuseColor.rgb;
	#include <opaque_fragment>
	#include <tonemapping_fragment>
	#include <colorspace_fragment>
	#include <fog_fragment>
	#include <premultiplied_alpha_fragment>
}`,Py=`#include <common>
#include <batching_pars_vertex>
#include <uv_pars_vertex>
#include <envmap_pars_vertex>
#include <color_pars_vertex>
#include <fog_pars_vertex>
#include <morphtarget_pars_vertex>
#include <skinning_pars_vertex>
#include <logdepthbuf_pars_vertex>
#include <clipping_planes_pars_vertex>
void main() {
	#include <uv_vertex>
	#include <color_vertex>
	#include <morphinstance_vertex>
	#include <morphcolor_vertex>
	#include <batching_vertex>
	#if defined ( USE_ENVMAP ) || defined ( USE_SKINNING )
		#include <beginnormal_vertex>
		#include <morphnormal_vertex>
		#include <skinbase_vertex>
		#include <skinnormal_vertex>
		#include <defaultnormal_vertex>
	#endif
	#include <begin_vertex>
	#include <morphtarget_vertex>
	#include <skinning_vertex>
	#include <project_vertex>
	#include <logdepthbuf_vertex>
	#include <clipping_planes_vertex>
	#include <worldpos_vertex>
	#include <envmap_vertex>
	#include <fog_vertex>
}`,Iy=`uniform vec3 diffuse;
uniform float opacity;
#ifndef FLAT_SHADED
	varying vec3 vNormal;
#endif
#include <common>
#include <dithering_pars_fragment>
#include <color_pars_fragment>
#include <uv_pars_fragment>
#include <map_pars_fragment>
#include <alphamap_pars_fragment>
#include <alphatest_pars_fragment>
#include <alphahash_pars_fragment>
#include <aomap_pars_fragment>
#include <lightmap_pars_fragment>
#include <envmap_common_pars_fragment>
#include <envmap_pars_fragment>
#include <fog_pars_fragment>
#include <specularmap_pars_fragment>
#include <logdepthbuf_pars_fragment>
#include <clipping_planes_pars_fragment>
void main() {
	vec4 diffuseColor = vec4( diffuse, opacity );
	#include <clipping_planes_fragment>
	#include <logdepthbuf_fragment>
	#include <map_fragment>
	#include <color_fragment>
	#include <alphamap_fragment>
	#include <alphatest_fragment>
	#include <alphahash_fragment>
	#include <specularmap_fragment>
	ReflectedLight reflectedLight = ReflectedLight( vec3( 0.0 ), vec3( 0.0 ), vec3( 0.0 ), vec3( 0.0 ) );
	#ifdef USE_LIGHTMAP
		vec4 lightMapTexel = texture2D( lightMap, vLightMapUv );
		reflectedLight.indirectDiffuse += lightMapTexel.rgb * lightMapIntensity * RECIPROCAL_PI;
	#else
		reflectedLight.indirectDiffuse += vec3( 1.0 );
	#endif
	#include <aomap_fragment>
	reflectedLight.indirectDiffuse *= diffuseColor.rgb;
	vec3 outgoingLight = reflectedLight.indirectDiffuse;
	#include <envmap_fragment>
	#include <opaque_fragment>
	#include <tonemapping_fragment>
	#include <colorspace_fragment>
	#include <fog_fragment>
	#include <premultiplied_alpha_fragment>
	#include <dithering_fragment>
}`,Ly=`#define LAMBERT
varying vec3 vViewPosition;
#include <common>
#include <batching_pars_vertex>
#include <uv_pars_vertex>
#include <displacementmap_pars_vertex>
#include <envmap_pars_vertex>
#include <color_pars_vertex>
#include <fog_pars_vertex>
#include <normal_pars_vertex>
#include <morphtarget_pars_vertex>
#include <skinning_pars_vertex>
#include <shadowmap_pars_vertex>
#include <logdepthbuf_pars_vertex>
#include <clipping_planes_pars_vertex>
void main() {
	#include <uv_vertex>
	#include <color_vertex>
	#include <morphinstance_vertex>
	#include <morphcolor_vertex>
	#include <batching_vertex>
	#include <beginnormal_vertex>
	#include <morphnormal_vertex>
	#include <skinbase_vertex>
	#include <skinnormal_vertex>
	#include <defaultnormal_vertex>
	#include <normal_vertex>
	#include <begin_vertex>
	#include <morphtarget_vertex>
	#include <skinning_vertex>
	#include <displacementmap_vertex>
	#include <project_vertex>
	#include <logdepthbuf_vertex>
	#include <clipping_planes_vertex>
	vViewPosition = - mvPosition.xyz;
	#include <worldpos_vertex>
	#include <envmap_vertex>
	#include <shadowmap_vertex>
	#include <fog_vertex>
}`,Dy=`#define LAMBERT
uniform vec3 diffuse;
uniform vec3 emissive;
uniform float opacity;
#include <common>
#include <dithering_pars_fragment>
#include <color_pars_fragment>
#include <uv_pars_fragment>
#include <map_pars_fragment>
#include <alphamap_pars_fragment>
#include <alphatest_pars_fragment>
#include <alphahash_pars_fragment>
#include <aomap_pars_fragment>
#include <lightmap_pars_fragment>
#include <emissivemap_pars_fragment>
#include <envmap_common_pars_fragment>
#include <envmap_pars_fragment>
#include <envmap_physical_pars_fragment>
#include <fog_pars_fragment>
#include <bsdfs>
#include <lights_pars_begin>
#include <normal_pars_fragment>
#include <lights_lambert_pars_fragment>
#include <shadowmap_pars_fragment>
#include <bumpmap_pars_fragment>
#include <normalmap_pars_fragment>
#include <specularmap_pars_fragment>
#include <logdepthbuf_pars_fragment>
#include <clipping_planes_pars_fragment>
void main() {
	vec4 diffuseColor = vec4( diffuse, opacity );
	#include <clipping_planes_fragment>
	ReflectedLight reflectedLight = ReflectedLight( vec3( 0.0 ), vec3( 0.0 ), vec3( 0.0 ), vec3( 0.0 ) );
	vec3 totalEmissiveRadiance = emissive;
	#include <logdepthbuf_fragment>
	#include <map_fragment>
	#include <color_fragment>
	#include <alphamap_fragment>
	#include <alphatest_fragment>
	#include <alphahash_fragment>
	#include <specularmap_fragment>
	#include <normal_fragment_begin>
	#include <normal_fragment_maps>
	#include <emissivemap_fragment>
	#include <lights_lambert_fragment>
	#include <lights_fragment_begin>
	#include <lights_fragment_maps>
	#include <lights_fragment_end>
	#include <aomap_fragment>
	vec3 outgoingLight = reflectedLight.directDiffuse + reflectedLight.indirectDiffuse + totalEmissiveRadiance;
	#include <envmap_fragment>
	#include <opaque_fragment>
	#include <tonemapping_fragment>
	#include <colorspace_fragment>
	#include <fog_fragment>
	#include <premultiplied_alpha_fragment>
	#include <dithering_fragment>
}`,Ny=`#define MATCAP
varying vec3 vViewPosition;
#include <common>
#include <batching_pars_vertex>
#include <uv_pars_vertex>
#include <color_pars_vertex>
#include <displacementmap_pars_vertex>
#include <fog_pars_vertex>
#include <normal_pars_vertex>
#include <morphtarget_pars_vertex>
#include <skinning_pars_vertex>
#include <logdepthbuf_pars_vertex>
#include <clipping_planes_pars_vertex>
void main() {
	#include <uv_vertex>
	#include <color_vertex>
	#include <morphinstance_vertex>
	#include <morphcolor_vertex>
	#include <batching_vertex>
	#include <beginnormal_vertex>
	#include <morphnormal_vertex>
	#include <skinbase_vertex>
	#include <skinnormal_vertex>
	#include <defaultnormal_vertex>
	#include <normal_vertex>
	#include <begin_vertex>
	#include <morphtarget_vertex>
	#include <skinning_vertex>
	#include <displacementmap_vertex>
	#include <project_vertex>
	#include <logdepthbuf_vertex>
	#include <clipping_planes_vertex>
	#include <fog_vertex>
	vViewPosition = - mvPosition.xyz;
}`,Fy=`#define MATCAP
uniform vec3 diffuse;
uniform float opacity;
uniform sampler2D matcap;
varying vec3 vViewPosition;
#include <common>
#include <dithering_pars_fragment>
#include <color_pars_fragment>
#include <uv_pars_fragment>
#include <map_pars_fragment>
#include <alphamap_pars_fragment>
#include <alphatest_pars_fragment>
#include <alphahash_pars_fragment>
#include <fog_pars_fragment>
#include <normal_pars_fragment>
#include <bumpmap_pars_fragment>
#include <normalmap_pars_fragment>
#include <logdepthbuf_pars_fragment>
#include <clipping_planes_pars_fragment>
void main() {
	vec4 diffuseColor = vec4( diffuse, opacity );
	#include <clipping_planes_fragment>
	#include <logdepthbuf_fragment>
	#include <map_fragment>
	#include <color_fragment>
	#include <alphamap_fragment>
	#include <alphatest_fragment>
	#include <alphahash_fragment>
	#include <normal_fragment_begin>
	#include <normal_fragment_maps>
	vec3 viewDir = normalize( vViewPosition );
	vec3 x = normalize( vec3( viewDir.z, 0.0, - viewDir.x ) );
	vec3 y = cross( viewDir, x );
	vec2 uv = vec2( dot( x, normal ), dot( y, normal ) ) * 0.495 + 0.5;
	#ifdef USE_MATCAP
		vec4 matcapColor = texture2D( matcap, uv );
	#else
		vec4 matcapColor = vec4( vec3( mix( 0.2, 0.8, uv.y ) ), 1.0 );
	#endif
	vec3 outgoingLight = diffuseColor.rgb * matcapColor.rgb;
	#include <opaque_fragment>
	#include <tonemapping_fragment>
	#include <colorspace_fragment>
	#include <fog_fragment>
	#include <premultiplied_alpha_fragment>
	#include <dithering_fragment>
}`,Uy=`#define NORMAL
#if defined( FLAT_SHADED ) || defined( USE_BUMPMAP ) || defined( USE_NORMALMAP_TANGENTSPACE )
	varying vec3 vViewPosition;
#endif
#include <common>
#include <batching_pars_vertex>
#include <uv_pars_vertex>
#include <displacementmap_pars_vertex>
#include <normal_pars_vertex>
#include <morphtarget_pars_vertex>
#include <skinning_pars_vertex>
#include <logdepthbuf_pars_vertex>
#include <clipping_planes_pars_vertex>
void main() {
	#include <uv_vertex>
	#include <batching_vertex>
	#include <beginnormal_vertex>
	#include <morphinstance_vertex>
	#include <morphnormal_vertex>
	#include <skinbase_vertex>
	#include <skinnormal_vertex>
	#include <defaultnormal_vertex>
	#include <normal_vertex>
	#include <begin_vertex>
	#include <morphtarget_vertex>
	#include <skinning_vertex>
	#include <displacementmap_vertex>
	#include <project_vertex>
	#include <logdepthbuf_vertex>
	#include <clipping_planes_vertex>
#if defined( FLAT_SHADED ) || defined( USE_BUMPMAP ) || defined( USE_NORMALMAP_TANGENTSPACE )
	vViewPosition = - mvPosition.xyz;
#endif
}`,Oy=`#define NORMAL
uniform float opacity;
#if defined( FLAT_SHADED ) || defined( USE_BUMPMAP ) || defined( USE_NORMALMAP_TANGENTSPACE )
	varying vec3 vViewPosition;
#endif
#include <uv_pars_fragment>
#include <normal_pars_fragment>
#include <bumpmap_pars_fragment>
#include <normalmap_pars_fragment>
#include <logdepthbuf_pars_fragment>
#include <clipping_planes_pars_fragment>
void main() {
	vec4 diffuseColor = vec4( 0.0, 0.0, 0.0, opacity );
	#include <clipping_planes_fragment>
	#include <logdepthbuf_fragment>
	#include <normal_fragment_begin>
	#include <normal_fragment_maps>
	gl_FragColor = vec4( normalize( normal ) * 0.5 + 0.5, diffuseColor.a );
	#ifdef OPAQUE
		gl_FragColor.a = 1.0;
	#endif
}`,By=`#define PHONG
varying vec3 vViewPosition;
#include <common>
#include <batching_pars_vertex>
#include <uv_pars_vertex>
#include <displacementmap_pars_vertex>
#include <envmap_pars_vertex>
#include <color_pars_vertex>
#include <fog_pars_vertex>
#include <normal_pars_vertex>
#include <morphtarget_pars_vertex>
#include <skinning_pars_vertex>
#include <shadowmap_pars_vertex>
#include <logdepthbuf_pars_vertex>
#include <clipping_planes_pars_vertex>
void main() {
	#include <uv_vertex>
	#include <color_vertex>
	#include <morphcolor_vertex>
	#include <batching_vertex>
	#include <beginnormal_vertex>
	#include <morphinstance_vertex>
	#include <morphnormal_vertex>
	#include <skinbase_vertex>
	#include <skinnormal_vertex>
	#include <defaultnormal_vertex>
	#include <normal_vertex>
	#include <begin_vertex>
	#include <morphtarget_vertex>
	#include <skinning_vertex>
	#include <displacementmap_vertex>
	#include <project_vertex>
	#include <logdepthbuf_vertex>
	#include <clipping_planes_vertex>
	vViewPosition = - mvPosition.xyz;
	#include <worldpos_vertex>
	#include <envmap_vertex>
	#include <shadowmap_vertex>
	#include <fog_vertex>
}`,ky=`#define PHONG
uniform vec3 diffuse;
uniform vec3 emissive;
uniform vec3 specular;
uniform float shininess;
uniform float opacity;
#include <common>
#include <dithering_pars_fragment>
#include <color_pars_fragment>
#include <uv_pars_fragment>
#include <map_pars_fragment>
#include <alphamap_pars_fragment>
#include <alphatest_pars_fragment>
#include <alphahash_pars_fragment>
#include <aomap_pars_fragment>
#include <lightmap_pars_fragment>
#include <emissivemap_pars_fragment>
#include <envmap_common_pars_fragment>
#include <envmap_pars_fragment>
#include <envmap_physical_pars_fragment>
#include <fog_pars_fragment>
#include <bsdfs>
#include <lights_pars_begin>
#include <normal_pars_fragment>
#include <lights_phong_pars_fragment>
#include <shadowmap_pars_fragment>
#include <bumpmap_pars_fragment>
#include <normalmap_pars_fragment>
#include <specularmap_pars_fragment>
#include <logdepthbuf_pars_fragment>
#include <clipping_planes_pars_fragment>
void main() {
	vec4 diffuseColor = vec4( diffuse, opacity );
	#include <clipping_planes_fragment>
	ReflectedLight reflectedLight = ReflectedLight( vec3( 0.0 ), vec3( 0.0 ), vec3( 0.0 ), vec3( 0.0 ) );
	vec3 totalEmissiveRadiance = emissive;
	#include <logdepthbuf_fragment>
	#include <map_fragment>
	#include <color_fragment>
	#include <alphamap_fragment>
	#include <alphatest_fragment>
	#include <alphahash_fragment>
	#include <specularmap_fragment>
	#include <normal_fragment_begin>
	#include <normal_fragment_maps>
	#include <emissivemap_fragment>
	#include <lights_phong_fragment>
	#include <lights_fragment_begin>
	#include <lights_fragment_maps>
	#include <lights_fragment_end>
	#include <aomap_fragment>
	vec3 outgoingLight = reflectedLight.directDiffuse + reflectedLight.indirectDiffuse + reflectedLight.directSpecular + reflectedLight.indirectSpecular + totalEmissiveRadiance;
	#include <envmap_fragment>
	#include <opaque_fragment>
	#include <tonemapping_fragment>
	#include <colorspace_fragment>
	#include <fog_fragment>
	#include <premultiplied_alpha_fragment>
	#include <dithering_fragment>
}`,zy=`#define STANDARD
varying vec3 vViewPosition;
#ifdef USE_TRANSMISSION
	varying vec3 vWorldPosition;
#endif
#include <common>
#include <batching_pars_vertex>
#include <uv_pars_vertex>
#include <displacementmap_pars_vertex>
#include <color_pars_vertex>
#include <fog_pars_vertex>
#include <normal_pars_vertex>
#include <morphtarget_pars_vertex>
#include <skinning_pars_vertex>
#include <shadowmap_pars_vertex>
#include <logdepthbuf_pars_vertex>
#include <clipping_planes_pars_vertex>
void main() {
	#include <uv_vertex>
	#include <color_vertex>
	#include <morphinstance_vertex>
	#include <morphcolor_vertex>
	#include <batching_vertex>
	#include <beginnormal_vertex>
	#include <morphnormal_vertex>
	#include <skinbase_vertex>
	#include <skinnormal_vertex>
	#include <defaultnormal_vertex>
	#include <normal_vertex>
	#include <begin_vertex>
	#include <morphtarget_vertex>
	#include <skinning_vertex>
	#include <displacementmap_vertex>
	#include <project_vertex>
	#include <logdepthbuf_vertex>
	#include <clipping_planes_vertex>
	vViewPosition = - mvPosition.xyz;
	#include <worldpos_vertex>
	#include <shadowmap_vertex>
	#include <fog_vertex>
#ifdef USE_TRANSMISSION
	vWorldPosition = worldPosition.xyz;
#endif
}`,Hy=`#define STANDARD
#ifdef PHYSICAL
	#define IOR
	#define USE_SPECULAR
#endif
uniform vec3 diffuse;
uniform vec3 emissive;
uniform float roughness;
uniform float metalness;
uniform float opacity;
#ifdef IOR
	uniform float ior;
#endif
#ifdef USE_SPECULAR
	uniform float specularIntensity;
	uniform vec3 specularColor;
	#ifdef USE_SPECULAR_COLORMAP
		uniform sampler2D specularColorMap;
	#endif
	#ifdef USE_SPECULAR_INTENSITYMAP
		uniform sampler2D specularIntensityMap;
	#endif
#endif
#ifdef USE_CLEARCOAT
	uniform float clearcoat;
	uniform float clearcoatRoughness;
#endif
#ifdef USE_DIFFUSE_ROUGHNESS
	uniform float diffuseRoughness;
	#ifdef USE_DIFFUSE_ROUGHNESSMAP
		uniform sampler2D diffuseRoughnessMap;
	#endif
#endif
#ifdef USE_DISPERSION
	uniform float dispersion;
#endif
#ifdef USE_RETROREFLECTION
	uniform float retroreflectivity;
#endif
#ifdef USE_IRIDESCENCE
	uniform float iridescence;
	uniform float iridescenceIOR;
	uniform float iridescenceThicknessMinimum;
	uniform float iridescenceThicknessMaximum;
#endif
#ifdef USE_SHEEN
	uniform vec3 sheenColor;
	uniform float sheenRoughness;
	#ifdef USE_SHEEN_COLORMAP
		uniform sampler2D sheenColorMap;
	#endif
	#ifdef USE_SHEEN_ROUGHNESSMAP
		uniform sampler2D sheenRoughnessMap;
	#endif
#endif
#ifdef USE_ANISOTROPY
	uniform vec2 anisotropyVector;
	#ifdef USE_ANISOTROPYMAP
		uniform sampler2D anisotropyMap;
	#endif
#endif
varying vec3 vViewPosition;
#include <common>
#include <dithering_pars_fragment>
#include <color_pars_fragment>
#include <uv_pars_fragment>
#include <map_pars_fragment>
#include <alphamap_pars_fragment>
#include <alphatest_pars_fragment>
#include <alphahash_pars_fragment>
#include <aomap_pars_fragment>
#include <lightmap_pars_fragment>
#include <emissivemap_pars_fragment>
#include <iridescence_fragment>
#include <envmap_common_pars_fragment>
#include <envmap_physical_pars_fragment>
#include <fog_pars_fragment>
#include <lights_pars_begin>
#include <normal_pars_fragment>
#include <lights_physical_pars_fragment>
#include <transmission_pars_fragment>
#include <shadowmap_pars_fragment>
#include <bumpmap_pars_fragment>
#include <normalmap_pars_fragment>
#include <clearcoat_pars_fragment>
#include <iridescence_pars_fragment>
#include <roughnessmap_pars_fragment>
#include <metalnessmap_pars_fragment>
#include <logdepthbuf_pars_fragment>
#include <clipping_planes_pars_fragment>
void main() {
	vec4 diffuseColor = vec4( diffuse, opacity );
	#include <clipping_planes_fragment>
	ReflectedLight reflectedLight = ReflectedLight( vec3( 0.0 ), vec3( 0.0 ), vec3( 0.0 ), vec3( 0.0 ) );
	vec3 totalEmissiveRadiance = emissive;
	#include <logdepthbuf_fragment>
	#include <map_fragment>
	#include <color_fragment>
	#include <alphamap_fragment>
	#include <alphatest_fragment>
	#include <alphahash_fragment>
	#include <roughnessmap_fragment>
	#include <metalnessmap_fragment>
	#include <normal_fragment_begin>
	#include <normal_fragment_maps>
	#include <clearcoat_normal_fragment_begin>
	#include <clearcoat_normal_fragment_maps>
	#include <emissivemap_fragment>
	#include <lights_physical_fragment>
	#include <lights_fragment_begin>
	#include <lights_fragment_maps>
	#include <lights_fragment_end>
	#include <aomap_fragment>
	vec3 totalDiffuse = reflectedLight.directDiffuse + reflectedLight.indirectDiffuse;
	vec3 totalSpecular = reflectedLight.directSpecular + reflectedLight.indirectSpecular;
	#include <transmission_fragment>
	vec3 outgoingLight = totalDiffuse + totalSpecular + totalEmissiveRadiance;
	#ifdef USE_SHEEN
 
		outgoingLight = outgoingLight + sheenSpecularDirect + sheenSpecularIndirect;
 
 	#endif
	#ifdef USE_CLEARCOAT
		float dotNVcc = saturate( dot( geometryClearcoatNormal, geometryViewDir ) );
		vec3 Fcc = F_Schlick( material.clearcoatF0, material.clearcoatF90, dotNVcc );
		outgoingLight = outgoingLight * ( 1.0 - material.clearcoat * Fcc ) + ( clearcoatSpecularDirect + clearcoatSpecularIndirect ) * material.clearcoat;
	#endif
	#include <opaque_fragment>
	#include <tonemapping_fragment>
	#include <colorspace_fragment>
	#include <fog_fragment>
	#include <premultiplied_alpha_fragment>
	#include <dithering_fragment>
}`,Vy=`#define TOON
varying vec3 vViewPosition;
#include <common>
#include <batching_pars_vertex>
#include <uv_pars_vertex>
#include <displacementmap_pars_vertex>
#include <color_pars_vertex>
#include <fog_pars_vertex>
#include <normal_pars_vertex>
#include <morphtarget_pars_vertex>
#include <skinning_pars_vertex>
#include <shadowmap_pars_vertex>
#include <logdepthbuf_pars_vertex>
#include <clipping_planes_pars_vertex>
void main() {
	#include <uv_vertex>
	#include <color_vertex>
	#include <morphinstance_vertex>
	#include <morphcolor_vertex>
	#include <batching_vertex>
	#include <beginnormal_vertex>
	#include <morphnormal_vertex>
	#include <skinbase_vertex>
	#include <skinnormal_vertex>
	#include <defaultnormal_vertex>
	#include <normal_vertex>
	#include <begin_vertex>
	#include <morphtarget_vertex>
	#include <skinning_vertex>
	#include <displacementmap_vertex>
	#include <project_vertex>
	#include <logdepthbuf_vertex>
	#include <clipping_planes_vertex>
	vViewPosition = - mvPosition.xyz;
	#include <worldpos_vertex>
	#include <shadowmap_vertex>
	#include <fog_vertex>
}`,Gy=`#define TOON
uniform vec3 diffuse;
uniform vec3 emissive;
uniform float opacity;
#include <common>
#include <dithering_pars_fragment>
#include <color_pars_fragment>
#include <uv_pars_fragment>
#include <map_pars_fragment>
#include <alphamap_pars_fragment>
#include <alphatest_pars_fragment>
#include <alphahash_pars_fragment>
#include <aomap_pars_fragment>
#include <lightmap_pars_fragment>
#include <emissivemap_pars_fragment>
#include <gradientmap_pars_fragment>
#include <fog_pars_fragment>
#include <bsdfs>
#include <lights_pars_begin>
#include <normal_pars_fragment>
#include <lights_toon_pars_fragment>
#include <shadowmap_pars_fragment>
#include <bumpmap_pars_fragment>
#include <normalmap_pars_fragment>
#include <logdepthbuf_pars_fragment>
#include <clipping_planes_pars_fragment>
void main() {
	vec4 diffuseColor = vec4( diffuse, opacity );
	#include <clipping_planes_fragment>
	ReflectedLight reflectedLight = ReflectedLight( vec3( 0.0 ), vec3( 0.0 ), vec3( 0.0 ), vec3( 0.0 ) );
	vec3 totalEmissiveRadiance = emissive;
	#include <logdepthbuf_fragment>
	#include <map_fragment>
	#include <color_fragment>
	#include <alphamap_fragment>
	#include <alphatest_fragment>
	#include <alphahash_fragment>
	#include <normal_fragment_begin>
	#include <normal_fragment_maps>
	#include <emissivemap_fragment>
	#include <lights_toon_fragment>
	#include <lights_fragment_begin>
	#include <lights_fragment_maps>
	#include <lights_fragment_end>
	#include <aomap_fragment>
	vec3 outgoingLight = reflectedLight.directDiffuse + reflectedLight.indirectDiffuse + totalEmissiveRadiance;
	#include <opaque_fragment>
	#include <tonemapping_fragment>
	#include <colorspace_fragment>
	#include <fog_fragment>
	#include <premultiplied_alpha_fragment>
	#include <dithering_fragment>
}`,Wy=`uniform float size;
uniform float scale;
#include <common>
#include <color_pars_vertex>
#include <fog_pars_vertex>
#include <morphtarget_pars_vertex>
#include <logdepthbuf_pars_vertex>
#include <clipping_planes_pars_vertex>
#ifdef USE_POINTS_UV
	varying vec2 vUv;
	uniform mat3 uvTransform;
#endif
void main() {
	#ifdef USE_POINTS_UV
		vUv = ( uvTransform * vec3( uv, 1 ) ).xy;
	#endif
	#include <color_vertex>
	#include <morphinstance_vertex>
	#include <morphcolor_vertex>
	#include <begin_vertex>
	#include <morphtarget_vertex>
	#include <project_vertex>
	gl_PointSize = size;
	#ifdef USE_SIZEATTENUATION
		bool isPerspective = isPerspectiveMatrix( projectionMatrix );
		if ( isPerspective ) gl_PointSize *= ( scale / - mvPosition.z );
	#endif
	#include <logdepthbuf_vertex>
	#include <clipping_planes_vertex>
	#include <worldpos_vertex>
	#include <fog_vertex>
}`,Xy=`uniform vec3 diffuse;
uniform float opacity;
#include <common>
#include <color_pars_fragment>
#include <map_particle_pars_fragment>
#include <alphatest_pars_fragment>
#include <alphahash_pars_fragment>
#include <fog_pars_fragment>
#include <logdepthbuf_pars_fragment>
#include <clipping_planes_pars_fragment>
void main() {
	vec4 diffuseColor = vec4( diffuse, opacity );
	#include <clipping_planes_fragment>
	vec3 outgoingLight = vec3( 0.0 );
	#include <logdepthbuf_fragment>
	#include <map_particle_fragment>
	#include <color_fragment>
	#include <alphatest_fragment>
	#include <alphahash_fragment>
	outgoingLight = diffuseColor.rgb;
	#include <opaque_fragment>
	#include <tonemapping_fragment>
	#include <colorspace_fragment>
	#include <fog_fragment>
	#include <premultiplied_alpha_fragment>
}`,qy=`#include <common>
#include <batching_pars_vertex>
#include <fog_pars_vertex>
#include <morphtarget_pars_vertex>
#include <skinning_pars_vertex>
#include <logdepthbuf_pars_vertex>
#include <shadowmap_pars_vertex>
void main() {
	#include <batching_vertex>
	#include <beginnormal_vertex>
	#include <morphinstance_vertex>
	#include <morphnormal_vertex>
	#include <skinbase_vertex>
	#include <skinnormal_vertex>
	#include <defaultnormal_vertex>
	#include <begin_vertex>
	#include <morphtarget_vertex>
	#include <skinning_vertex>
	#include <project_vertex>
	#include <logdepthbuf_vertex>
	#include <worldpos_vertex>
	#include <shadowmap_vertex>
	#include <fog_vertex>
}`,Yy=`uniform vec3 color;
uniform float opacity;
#include <common>
#include <fog_pars_fragment>
#include <bsdfs>
#include <lights_pars_begin>
#include <logdepthbuf_pars_fragment>
#include <shadowmap_pars_fragment>
#include <shadowmask_pars_fragment>
void main() {
	#include <logdepthbuf_fragment>
	gl_FragColor = vec4( color, opacity * ( 1.0 - getShadowMask() ) );
	#include <tonemapping_fragment>
	#include <colorspace_fragment>
	#include <fog_fragment>
	#include <premultiplied_alpha_fragment>
}`,$y=`uniform float rotation;
uniform vec2 center;
#include <common>
#include <uv_pars_vertex>
#include <fog_pars_vertex>
#include <logdepthbuf_pars_vertex>
#include <clipping_planes_pars_vertex>
void main() {
	#include <uv_vertex>
	vec4 mvPosition = modelViewMatrix[ 3 ];
	vec2 scale = vec2( length( modelMatrix[ 0 ].xyz ), length( modelMatrix[ 1 ].xyz ) );
	#ifndef USE_SIZEATTENUATION
		bool isPerspective = isPerspectiveMatrix( projectionMatrix );
		if ( isPerspective ) scale *= - mvPosition.z;
	#endif
	vec2 alignedPosition = ( position.xy - ( center - vec2( 0.5 ) ) ) * scale;
	vec2 rotatedPosition;
	rotatedPosition.x = cos( rotation ) * alignedPosition.x - sin( rotation ) * alignedPosition.y;
	rotatedPosition.y = sin( rotation ) * alignedPosition.x + cos( rotation ) * alignedPosition.y;
	mvPosition.xy += rotatedPosition;
	gl_Position = projectionMatrix * mvPosition;
	#include <logdepthbuf_vertex>
	#include <clipping_planes_vertex>
	#include <fog_vertex>
}`,Zy=`uniform vec3 diffuse;
uniform float opacity;
#include <common>
#include <uv_pars_fragment>
#include <map_pars_fragment>
#include <alphamap_pars_fragment>
#include <alphatest_pars_fragment>
#include <alphahash_pars_fragment>
#include <fog_pars_fragment>
#include <logdepthbuf_pars_fragment>
#include <clipping_planes_pars_fragment>
void main() {
	vec4 diffuseColor = vec4( diffuse, opacity );
	#include <clipping_planes_fragment>
	vec3 outgoingLight = vec3( 0.0 );
	#include <logdepthbuf_fragment>
	#include <map_fragment>
	#include <alphamap_fragment>
	#include <alphatest_fragment>
	#include <alphahash_fragment>
	outgoingLight = diffuseColor.rgb;
	#include <opaque_fragment>
	#include <tonemapping_fragment>
	#include <colorspace_fragment>
	#include <fog_fragment>
}`,dt={alphahash_fragment:v_,alphahash_pars_fragment:__,alphamap_fragment:x_,alphamap_pars_fragment:y_,alphatest_fragment:b_,alphatest_pars_fragment:S_,aomap_fragment:M_,aomap_pars_fragment:w_,batching_pars_vertex:E_,batching_vertex:T_,begin_vertex:A_,beginnormal_vertex:R_,bsdfs:C_,iridescence_fragment:P_,bumpmap_pars_fragment:I_,clipping_planes_fragment:L_,clipping_planes_pars_fragment:D_,clipping_planes_pars_vertex:N_,clipping_planes_vertex:F_,color_fragment:U_,color_pars_fragment:O_,color_pars_vertex:B_,color_vertex:k_,common:z_,defaultnormal_vertex:H_,displacementmap_pars_vertex:V_,displacementmap_vertex:G_,emissivemap_fragment:W_,emissivemap_pars_fragment:X_,colorspace_fragment:q_,colorspace_pars_fragment:Y_,envmap_fragment:$_,envmap_common_pars_fragment:Z_,envmap_pars_fragment:K_,envmap_pars_vertex:J_,envmap_physical_pars_fragment:lx,envmap_vertex:j_,fog_vertex:Q_,fog_pars_vertex:ex,fog_fragment:tx,fog_pars_fragment:nx,gradientmap_pars_fragment:ix,lightmap_pars_fragment:sx,lights_lambert_fragment:rx,lights_lambert_pars_fragment:ox,lights_pars_begin:ax,lights_toon_fragment:cx,lights_toon_pars_fragment:hx,lights_phong_fragment:ux,lights_phong_pars_fragment:dx,lights_physical_fragment:fx,lights_physical_pars_fragment:px,lights_fragment_begin:mx,lights_fragment_maps:gx,lights_fragment_end:vx,lightprobes_pars_fragment:_x,logdepthbuf_fragment:xx,logdepthbuf_pars_fragment:yx,logdepthbuf_pars_vertex:bx,logdepthbuf_vertex:Sx,map_fragment:Mx,map_pars_fragment:wx,map_particle_fragment:Ex,map_particle_pars_fragment:Tx,metalnessmap_fragment:Ax,metalnessmap_pars_fragment:Rx,morphinstance_vertex:Cx,morphcolor_vertex:Px,morphnormal_vertex:Ix,morphtarget_pars_vertex:Lx,morphtarget_vertex:Dx,normal_fragment_begin:Nx,normal_fragment_maps:Fx,normal_pars_fragment:Ux,normal_pars_vertex:Ox,normal_vertex:Bx,normalmap_pars_fragment:kx,clearcoat_normal_fragment_begin:zx,clearcoat_normal_fragment_maps:Hx,clearcoat_pars_fragment:Vx,iridescence_pars_fragment:Gx,opaque_fragment:Wx,packing:Xx,premultiplied_alpha_fragment:qx,project_vertex:Yx,dithering_fragment:$x,dithering_pars_fragment:Zx,roughnessmap_fragment:Kx,roughnessmap_pars_fragment:Jx,shadowmap_pars_fragment:jx,shadowmap_pars_vertex:Qx,shadowmap_vertex:ey,shadowmask_pars_fragment:ty,skinbase_vertex:ny,skinning_pars_vertex:iy,skinning_vertex:sy,skinnormal_vertex:ry,specularmap_fragment:oy,specularmap_pars_fragment:ay,tonemapping_fragment:ly,tonemapping_pars_fragment:cy,transmission_fragment:hy,transmission_pars_fragment:uy,uv_pars_fragment:dy,uv_pars_vertex:fy,uv_vertex:py,worldpos_vertex:my,background_vert:gy,background_frag:vy,backgroundCube_vert:_y,backgroundCube_frag:xy,cube_vert:yy,cube_frag:by,depth_vert:Sy,depth_frag:My,distance_vert:wy,distance_frag:Ey,equirect_vert:Ty,equirect_frag:Ay,linedashed_vert:Ry,linedashed_frag:Cy,meshbasic_vert:Py,meshbasic_frag:Iy,meshlambert_vert:Ly,meshlambert_frag:Dy,meshmatcap_vert:Ny,meshmatcap_frag:Fy,meshnormal_vert:Uy,meshnormal_frag:Oy,meshphong_vert:By,meshphong_frag:ky,meshphysical_vert:zy,meshphysical_frag:Hy,meshtoon_vert:Vy,meshtoon_frag:Gy,points_vert:Wy,points_frag:Xy,shadow_vert:qy,shadow_frag:Yy,sprite_vert:$y,sprite_frag:Zy},Le={common:{diffuse:{value:new xt(16777215)},opacity:{value:1},map:{value:null},mapTransform:{value:new qe},alphaMap:{value:null},alphaMapTransform:{value:new qe},alphaTest:{value:0}},specularmap:{specularMap:{value:null},specularMapTransform:{value:new qe}},envmap:{envMap:{value:null},envMapRotation:{value:new qe},reflectivity:{value:1},ior:{value:1.5},refractionRatio:{value:.98},dfgLUT:{value:null}},aomap:{aoMap:{value:null},aoMapIntensity:{value:1},aoMapTransform:{value:new qe}},lightmap:{lightMap:{value:null},lightMapIntensity:{value:1},lightMapTransform:{value:new qe}},bumpmap:{bumpMap:{value:null},bumpMapTransform:{value:new qe},bumpScale:{value:1}},normalmap:{normalMap:{value:null},normalMapTransform:{value:new qe},normalScale:{value:new vt(1,1)}},displacementmap:{displacementMap:{value:null},displacementMapTransform:{value:new qe},displacementScale:{value:1},displacementBias:{value:0}},emissivemap:{emissiveMap:{value:null},emissiveMapTransform:{value:new qe}},metalnessmap:{metalnessMap:{value:null},metalnessMapTransform:{value:new qe}},roughnessmap:{roughnessMap:{value:null},roughnessMapTransform:{value:new qe}},gradientmap:{gradientMap:{value:null}},fog:{fogDensity:{value:25e-5},fogNear:{value:1},fogFar:{value:2e3},fogColor:{value:new xt(16777215)}},lights:{ambientLightColor:{value:[]},lightProbe:{value:[]},sunLights:{value:[],properties:{direction:{},color:{}}},sunLightShadows:{value:[],properties:{shadowIntensity:1,shadowBias:{},shadowNormalBias:{},shadowRadius:{},shadowMapSize:{}}},sunShadowMatrix:{value:[]},sunShadowCascade:{value:[]},directionalLights:{value:[],properties:{direction:{},color:{}}},directionalLightShadows:{value:[],properties:{shadowIntensity:1,shadowBias:{},shadowNormalBias:{},shadowRadius:{},shadowMapSize:{}}},directionalShadowMatrix:{value:[]},spotLights:{value:[],properties:{color:{},position:{},direction:{},distance:{},coneCos:{},penumbraCos:{},decay:{}}},spotLightShadows:{value:[],properties:{shadowIntensity:1,shadowBias:{},shadowNormalBias:{},shadowRadius:{},shadowMapSize:{}}},spotLightMap:{value:[]},spotLightMatrix:{value:[]},pointLights:{value:[],properties:{color:{},position:{},decay:{},distance:{}}},pointLightShadows:{value:[],properties:{shadowIntensity:1,shadowBias:{},shadowNormalBias:{},shadowRadius:{},shadowMapSize:{},shadowCameraNear:{},shadowCameraFar:{}}},pointShadowMatrix:{value:[]},hemisphereLights:{value:[],properties:{direction:{},skyColor:{},groundColor:{}}},rectAreaLights:{value:[],properties:{color:{},position:{},width:{},height:{}}},ltc_1:{value:null},ltc_2:{value:null},probesSH:{value:[]},probesMin:{value:[]},probesMax:{value:[]},probesResolution:{value:[]}},points:{diffuse:{value:new xt(16777215)},opacity:{value:1},size:{value:1},scale:{value:1},map:{value:null},alphaMap:{value:null},alphaMapTransform:{value:new qe},alphaTest:{value:0},uvTransform:{value:new qe}},sprite:{diffuse:{value:new xt(16777215)},opacity:{value:1},center:{value:new vt(.5,.5)},rotation:{value:0},map:{value:null},mapTransform:{value:new qe},alphaMap:{value:null},alphaMapTransform:{value:new qe},alphaTest:{value:0}}},as={basic:{uniforms:Wn([Le.common,Le.specularmap,Le.envmap,Le.aomap,Le.lightmap,Le.fog]),vertexShader:dt.meshbasic_vert,fragmentShader:dt.meshbasic_frag},lambert:{uniforms:Wn([Le.common,Le.specularmap,Le.envmap,Le.aomap,Le.lightmap,Le.emissivemap,Le.bumpmap,Le.normalmap,Le.displacementmap,Le.fog,Le.lights,{emissive:{value:new xt(0)},envMapIntensity:{value:1}}]),vertexShader:dt.meshlambert_vert,fragmentShader:dt.meshlambert_frag},phong:{uniforms:Wn([Le.common,Le.specularmap,Le.envmap,Le.aomap,Le.lightmap,Le.emissivemap,Le.bumpmap,Le.normalmap,Le.displacementmap,Le.fog,Le.lights,{emissive:{value:new xt(0)},specular:{value:new xt(1118481)},shininess:{value:30},envMapIntensity:{value:1}}]),vertexShader:dt.meshphong_vert,fragmentShader:dt.meshphong_frag},standard:{uniforms:Wn([Le.common,Le.envmap,Le.aomap,Le.lightmap,Le.emissivemap,Le.bumpmap,Le.normalmap,Le.displacementmap,Le.roughnessmap,Le.metalnessmap,Le.fog,Le.lights,{emissive:{value:new xt(0)},roughness:{value:1},metalness:{value:0},envMapIntensity:{value:1}}]),vertexShader:dt.meshphysical_vert,fragmentShader:dt.meshphysical_frag},toon:{uniforms:Wn([Le.common,Le.aomap,Le.lightmap,Le.emissivemap,Le.bumpmap,Le.normalmap,Le.displacementmap,Le.gradientmap,Le.fog,Le.lights,{emissive:{value:new xt(0)}}]),vertexShader:dt.meshtoon_vert,fragmentShader:dt.meshtoon_frag},matcap:{uniforms:Wn([Le.common,Le.bumpmap,Le.normalmap,Le.displacementmap,Le.fog,{matcap:{value:null}}]),vertexShader:dt.meshmatcap_vert,fragmentShader:dt.meshmatcap_frag},points:{uniforms:Wn([Le.points,Le.fog]),vertexShader:dt.points_vert,fragmentShader:dt.points_frag},dashed:{uniforms:Wn([Le.common,Le.fog,{scale:{value:1},dashSize:{value:1},totalSize:{value:2}}]),vertexShader:dt.linedashed_vert,fragmentShader:dt.linedashed_frag},depth:{uniforms:Wn([Le.common,Le.displacementmap]),vertexShader:dt.depth_vert,fragmentShader:dt.depth_frag},normal:{uniforms:Wn([Le.common,Le.bumpmap,Le.normalmap,Le.displacementmap,{opacity:{value:1}}]),vertexShader:dt.meshnormal_vert,fragmentShader:dt.meshnormal_frag},sprite:{uniforms:Wn([Le.sprite,Le.fog]),vertexShader:dt.sprite_vert,fragmentShader:dt.sprite_frag},background:{uniforms:{uvTransform:{value:new qe},t2D:{value:null},backgroundIntensity:{value:1}},vertexShader:dt.background_vert,fragmentShader:dt.background_frag},backgroundCube:{uniforms:{envMap:{value:null},backgroundBlurriness:{value:0},backgroundIntensity:{value:1},backgroundRotation:{value:new qe}},vertexShader:dt.backgroundCube_vert,fragmentShader:dt.backgroundCube_frag},cube:{uniforms:{tCube:{value:null},tFlip:{value:-1},opacity:{value:1}},vertexShader:dt.cube_vert,fragmentShader:dt.cube_frag},equirect:{uniforms:{tEquirect:{value:null}},vertexShader:dt.equirect_vert,fragmentShader:dt.equirect_frag},distance:{uniforms:Wn([Le.common,Le.displacementmap,{referencePosition:{value:new k},nearDistance:{value:1},farDistance:{value:1e3}}]),vertexShader:dt.distance_vert,fragmentShader:dt.distance_frag},shadow:{uniforms:Wn([Le.lights,Le.fog,{color:{value:new xt(0)},opacity:{value:1}}]),vertexShader:dt.shadow_vert,fragmentShader:dt.shadow_frag}};as.physical={uniforms:Wn([as.standard.uniforms,{clearcoat:{value:0},clearcoatMap:{value:null},clearcoatMapTransform:{value:new qe},clearcoatNormalMap:{value:null},clearcoatNormalMapTransform:{value:new qe},clearcoatNormalScale:{value:new vt(1,1)},clearcoatRoughness:{value:0},clearcoatRoughnessMap:{value:null},clearcoatRoughnessMapTransform:{value:new qe},diffuseRoughness:{value:0},diffuseRoughnessMap:{value:null},diffuseRoughnessMapTransform:{value:new qe},dispersion:{value:0},retroreflectivity:{value:0},iridescence:{value:0},iridescenceMap:{value:null},iridescenceMapTransform:{value:new qe},iridescenceIOR:{value:1.3},iridescenceThicknessMinimum:{value:100},iridescenceThicknessMaximum:{value:400},iridescenceThicknessMap:{value:null},iridescenceThicknessMapTransform:{value:new qe},sheen:{value:0},sheenColor:{value:new xt(0)},sheenColorMap:{value:null},sheenColorMapTransform:{value:new qe},sheenRoughness:{value:1},sheenRoughnessMap:{value:null},sheenRoughnessMapTransform:{value:new qe},transmission:{value:0},transmissionMap:{value:null},transmissionMapTransform:{value:new qe},transmissionSamplerSize:{value:new vt},transmissionSamplerMap:{value:null},thickness:{value:0},thicknessMap:{value:null},thicknessMapTransform:{value:new qe},attenuationDistance:{value:0},attenuationColor:{value:new xt(0)},specularColor:{value:new xt(1,1,1)},specularColorMap:{value:null},specularColorMapTransform:{value:new qe},specularIntensity:{value:1},specularIntensityMap:{value:null},specularIntensityMapTransform:{value:new qe},anisotropyVector:{value:new vt},anisotropyMap:{value:null},anisotropyMapTransform:{value:new qe}}]),vertexShader:dt.meshphysical_vert,fragmentShader:dt.meshphysical_frag};var Wc={r:0,b:0,g:0},Ky=new it,Pm=new qe;Pm.set(-1,0,0,0,1,0,0,0,1);function Jy(i,e,t,n,s,r){let o=new xt(0),a=s===!0?0:1,l,c,h=null,u=0,d=null;function f(y){let R=y.isScene===!0?y.background:null;if(R&&R.isTexture){let b=y.backgroundBlurriness>0;R=e.get(R,b)}return R}function g(y){let R=!1,b=f(y);b===null?p(o,a):b&&b.isColor&&(p(b,1),R=!0);let A=i.xr.getEnvironmentBlendMode();A==="additive"?t.buffers.color.setClear(0,0,0,1,r):A==="alpha-blend"&&t.buffers.color.setClear(0,0,0,0,r),(i.autoClear||R)&&(t.buffers.depth.setTest(!0),t.buffers.depth.setMask(!0),t.buffers.color.setMask(!0),i.clear(i.autoClearColor,i.autoClearDepth,i.autoClearStencil))}function v(y,R){let b=f(R);b&&b.isCubeTexture?(c===void 0&&(c=new Bt(new ws(1,1,1),new Wt({name:"BackgroundCubeMaterial",uniforms:Er(as.backgroundCube.uniforms),vertexShader:as.backgroundCube.vertexShader,fragmentShader:as.backgroundCube.fragmentShader,side:Jn,depthTest:!1,depthWrite:!1,fog:!1,allowOverride:!1})),c.geometry.deleteAttribute("normal"),c.geometry.deleteAttribute("uv"),c.onBeforeRender=function(A,E,_){this.matrixWorld.copyPosition(_.matrixWorld)},Object.defineProperty(c.material,"envMap",{get:function(){return this.uniforms.envMap.value}}),n.update(c)),c.material.uniforms.envMap.value=b,c.material.uniforms.backgroundBlurriness.value=R.backgroundBlurriness,c.material.uniforms.backgroundIntensity.value=R.backgroundIntensity,c.material.uniforms.backgroundRotation.value.setFromMatrix4(Ky.makeRotationFromEuler(R.backgroundRotation)).transpose(),b.isRenderTargetTexture===!1&&c.material.uniforms.backgroundRotation.value.premultiply(Pm),c.material.toneMapped=gt.getTransfer(b.colorSpace)!==Pt,(h!==b||u!==b.version||d!==i.toneMapping)&&(c.material.needsUpdate=!0,h=b,u=b.version,d=i.toneMapping),c.layers.enableAll(),y.unshift(c,c.geometry,c.material,0,0,null)):b&&b.isTexture&&(l===void 0&&(l=new Bt(new Qs(2,2),new Wt({name:"BackgroundMaterial",uniforms:Er(as.background.uniforms),vertexShader:as.background.vertexShader,fragmentShader:as.background.fragmentShader,side:ss,depthTest:!1,depthWrite:!1,fog:!1,allowOverride:!1})),l.geometry.deleteAttribute("normal"),Object.defineProperty(l.material,"map",{get:function(){return this.uniforms.t2D.value}}),n.update(l)),l.material.uniforms.t2D.value=b,l.material.uniforms.backgroundIntensity.value=R.backgroundIntensity,l.material.toneMapped=gt.getTransfer(b.colorSpace)!==Pt,b.matrixAutoUpdate===!0&&b.updateMatrix(),l.material.uniforms.uvTransform.value.copy(b.matrix),(h!==b||u!==b.version||d!==i.toneMapping)&&(l.material.needsUpdate=!0,h=b,u=b.version,d=i.toneMapping),l.layers.enableAll(),y.unshift(l,l.geometry,l.material,0,0,null))}function p(y,R){y.getRGB(Wc,id(i)),t.buffers.color.setClear(Wc.r,Wc.g,Wc.b,R,r)}function m(){c!==void 0&&(c.geometry.dispose(),c.material.dispose(),c=void 0),l!==void 0&&(l.geometry.dispose(),l.material.dispose(),l=void 0)}return{getClearColor:function(){return o},setClearColor:function(y,R=1){o.set(y),a=R,p(o,a)},getClearAlpha:function(){return a},setClearAlpha:function(y){a=y,p(o,a)},render:g,addToRenderList:v,dispose:m}}function jy(i,e){let t=i.getParameter(i.MAX_VERTEX_ATTRIBS),n={},s=d(null),r=s,o=!1;function a(L,H,V,N,X){let $=!1,W=u(L,N,V,H);r!==W&&(r=W,c(r.object)),$=f(L,N,V,X),$&&g(L,N,V,X),X!==null&&e.update(X,i.ELEMENT_ARRAY_BUFFER),($||o)&&(o=!1,b(L,H,V,N),X!==null&&i.bindBuffer(i.ELEMENT_ARRAY_BUFFER,e.get(X).buffer))}function l(){return i.createVertexArray()}function c(L){return i.bindVertexArray(L)}function h(L){return i.deleteVertexArray(L)}function u(L,H,V,N){let X=N.wireframe===!0,$=n[H.id];$===void 0&&($={},n[H.id]=$);let W=L.isInstancedMesh===!0?L.id:0,ce=$[W];ce===void 0&&(ce={},$[W]=ce);let J=ce[V.id];J===void 0&&(J={},ce[V.id]=J);let Q=J[X];return Q===void 0&&(Q=d(l()),J[X]=Q),Q}function d(L){let H=[],V=[],N=[];for(let X=0;X<t;X++)H[X]=0,V[X]=0,N[X]=0;return{geometry:null,program:null,wireframe:!1,newAttributes:H,enabledAttributes:V,attributeDivisors:N,object:L,attributes:{},index:null}}function f(L,H,V,N){let X=r.attributes,$=H.attributes,W=0,ce=V.getAttributes();for(let J in ce)if(ce[J].location>=0){let se=X[J],de=$[J];if(de===void 0&&(J==="instanceMatrix"&&L.instanceMatrix&&(de=L.instanceMatrix),J==="instanceColor"&&L.instanceColor&&(de=L.instanceColor)),se===void 0||se.attribute!==de||de&&se.data!==de.data)return!0;W++}return r.attributesNum!==W||r.index!==N}function g(L,H,V,N){let X={},$=H.attributes,W=0,ce=V.getAttributes();for(let J in ce)if(ce[J].location>=0){let se=$[J];se===void 0&&(J==="instanceMatrix"&&L.instanceMatrix&&(se=L.instanceMatrix),J==="instanceColor"&&L.instanceColor&&(se=L.instanceColor));let de={};de.attribute=se,se&&se.data&&(de.data=se.data),X[J]=de,W++}r.attributes=X,r.attributesNum=W,r.index=N}function v(){let L=r.newAttributes;for(let H=0,V=L.length;H<V;H++)L[H]=0}function p(L){m(L,0)}function m(L,H){let V=r.newAttributes,N=r.enabledAttributes,X=r.attributeDivisors;V[L]=1,N[L]===0&&(i.enableVertexAttribArray(L),N[L]=1),X[L]!==H&&(i.vertexAttribDivisor(L,H),X[L]=H)}function y(){let L=r.newAttributes,H=r.enabledAttributes;for(let V=0,N=H.length;V<N;V++)H[V]!==L[V]&&(i.disableVertexAttribArray(V),H[V]=0)}function R(L,H,V,N,X,$,W){W===!0?i.vertexAttribIPointer(L,H,V,X,$):i.vertexAttribPointer(L,H,V,N,X,$)}function b(L,H,V,N){v();let X=N.attributes,$=V.getAttributes(),W=H.defaultAttributeValues;for(let ce in $){let J=$[ce];if(J.location>=0){let Q=X[ce];if(Q===void 0&&(ce==="instanceMatrix"&&L.instanceMatrix&&(Q=L.instanceMatrix),ce==="instanceColor"&&L.instanceColor&&(Q=L.instanceColor)),Q!==void 0){let se=Q.normalized,de=Q.itemSize,ue=e.get(Q);if(ue===void 0)continue;let ee=ue.buffer,me=ue.type,_e=ue.bytesPerElement,Ae=me===i.INT||me===i.UNSIGNED_INT||Q.gpuType===ac;if(Q.isInterleavedBufferAttribute){let Se=Q.data,Ge=Se.isInterleavedBuffer===!0?Se.stride:Se.itemSize,st=Q.offset;if(Se.isInstancedInterleavedBuffer||Se.isInstancedBufferAttribute){for(let He=0;He<J.locationSize;He++)m(J.location+He,Se.meshPerAttribute);L.isInstancedMesh!==!0&&N._maxInstanceCount===void 0&&(N._maxInstanceCount=Se.meshPerAttribute*Se.count)}else for(let He=0;He<J.locationSize;He++)p(J.location+He);i.bindBuffer(i.ARRAY_BUFFER,ee);for(let He=0;He<J.locationSize;He++)R(J.location+He,de/J.locationSize,me,se,Ge*_e,(st+de/J.locationSize*He)*_e,Ae)}else{if(Q.isInstancedBufferAttribute){for(let Se=0;Se<J.locationSize;Se++)m(J.location+Se,Q.meshPerAttribute);L.isInstancedMesh!==!0&&N._maxInstanceCount===void 0&&(N._maxInstanceCount=Q.meshPerAttribute*Q.count)}else for(let Se=0;Se<J.locationSize;Se++)p(J.location+Se);i.bindBuffer(i.ARRAY_BUFFER,ee);for(let Se=0;Se<J.locationSize;Se++)R(J.location+Se,de/J.locationSize,me,se,de*_e,de/J.locationSize*Se*_e,Ae)}}else if(W!==void 0){let se=W[ce];if(se!==void 0)switch(se.length){case 2:i.vertexAttrib2fv(J.location,se);break;case 3:i.vertexAttrib3fv(J.location,se);break;case 4:i.vertexAttrib4fv(J.location,se);break;default:i.vertexAttrib1fv(J.location,se)}}}}y()}function A(){O();for(let L in n){let H=n[L];for(let V in H){let N=H[V];for(let X in N){let $=N[X];for(let W in $)h($[W].object),delete $[W];delete N[X]}}delete n[L]}}function E(L){if(n[L.id]===void 0)return;let H=n[L.id];for(let V in H){let N=H[V];for(let X in N){let $=N[X];for(let W in $)h($[W].object),delete $[W];delete N[X]}}delete n[L.id]}function _(L){for(let H in n){let V=n[H];for(let N in V){let X=V[N];if(X[L.id]===void 0)continue;let $=X[L.id];for(let W in $)h($[W].object),delete $[W];delete X[L.id]}}}function T(L){for(let H in n){let V=n[H],N=L.isInstancedMesh===!0?L.id:0,X=V[N];if(X!==void 0){for(let $ in X){let W=X[$];for(let ce in W)h(W[ce].object),delete W[ce];delete X[$]}delete V[N],Object.keys(V).length===0&&delete n[H]}}}function O(){I(),o=!0,r!==s&&(r=s,c(r.object))}function I(){s.geometry=null,s.program=null,s.wireframe=!1}return{setup:a,reset:O,resetDefaultState:I,dispose:A,releaseStatesOfGeometry:E,releaseStatesOfObject:T,releaseStatesOfProgram:_,initAttributes:v,enableAttribute:p,disableUnusedAttributes:y}}function Qy(i,e,t){let n;function s(l){n=l}function r(l,c){i.drawArrays(n,l,c),t.update(c,n,1)}function o(l,c,h){h!==0&&(i.drawArraysInstanced(n,l,c,h),t.update(c,n,h))}function a(l,c,h){if(h===0)return;e.get("WEBGL_multi_draw").multiDrawArraysWEBGL(n,l,0,c,0,h);let d=0;for(let f=0;f<h;f++)d+=c[f];t.update(d,n,1)}this.setMode=s,this.render=r,this.renderInstances=o,this.renderMultiDraw=a}function eb(i,e,t,n){let s;function r(){if(s!==void 0)return s;if(e.has("EXT_texture_filter_anisotropic")===!0){let _=e.get("EXT_texture_filter_anisotropic");s=i.getParameter(_.MAX_TEXTURE_MAX_ANISOTROPY_EXT)}else s=0;return s}function o(_){return!(_!==yi&&n.convert(_)!==i.getParameter(i.IMPLEMENTATION_COLOR_READ_FORMAT))}function a(_){let T=_===Vi&&(e.has("EXT_color_buffer_half_float")||e.has("EXT_color_buffer_float"));return!(_!==_i&&_!==ti&&!T&&n.convert(_)!==i.getParameter(i.IMPLEMENTATION_COLOR_READ_TYPE))}function l(_){if(_==="highp"){if(i.getShaderPrecisionFormat(i.VERTEX_SHADER,i.HIGH_FLOAT).precision>0&&i.getShaderPrecisionFormat(i.FRAGMENT_SHADER,i.HIGH_FLOAT).precision>0)return"highp";_="mediump"}return _==="mediump"&&i.getShaderPrecisionFormat(i.VERTEX_SHADER,i.MEDIUM_FLOAT).precision>0&&i.getShaderPrecisionFormat(i.FRAGMENT_SHADER,i.MEDIUM_FLOAT).precision>0?"mediump":"lowp"}let c=t.precision!==void 0?t.precision:"highp",h=l(c);h!==c&&($e("WebGLRenderer:",c,"not supported, using",h,"instead."),c=h);let u=t.reversedDepthBuffer===!0&&e.has("EXT_clip_control"),d=t.logarithmicDepthBuffer===!0&&u===!1;t.reversedDepthBuffer===!0&&u===!1&&$e("WebGLRenderer: Unable to use reversed depth buffer due to missing EXT_clip_control extension. Fallback to default depth buffer."),t.logarithmicDepthBuffer===!0&&u===!0&&$e("WebGLRenderer: Logarithmic depth buffer is ignored when reversed depth buffer is enabled.");let f=i.getParameter(i.MAX_TEXTURE_IMAGE_UNITS),g=i.getParameter(i.MAX_VERTEX_TEXTURE_IMAGE_UNITS),v=i.getParameter(i.MAX_TEXTURE_SIZE),p=i.getParameter(i.MAX_CUBE_MAP_TEXTURE_SIZE),m=i.getParameter(i.MAX_VERTEX_ATTRIBS),y=i.getParameter(i.MAX_VERTEX_UNIFORM_VECTORS),R=i.getParameter(i.MAX_VARYING_VECTORS),b=i.getParameter(i.MAX_FRAGMENT_UNIFORM_VECTORS),A=i.getParameter(i.MAX_SAMPLES),E=i.getParameter(i.SAMPLES);return{isWebGL2:!0,getMaxAnisotropy:r,getMaxPrecision:l,textureFormatReadable:o,textureTypeReadable:a,precision:c,logarithmicDepthBuffer:d,reversedDepthBuffer:u,maxTextures:f,maxVertexTextures:g,maxTextureSize:v,maxCubemapSize:p,maxAttributes:m,maxVertexUniforms:y,maxVaryings:R,maxFragmentUniforms:b,maxSamples:A,samples:E}}function tb(i){let e=this,t=null,n=0,s=!1,r=!1,o=new zi,a=new qe,l={value:null,needsUpdate:!1};this.uniform=l,this.numPlanes=0,this.numIntersection=0,this.init=function(u,d){let f=u.length!==0||d||n!==0||s;return s=d,n=u.length,f},this.beginShadows=function(){r=!0,h(null)},this.endShadows=function(){r=!1},this.setGlobalState=function(u,d){t=h(u,d,0)},this.setState=function(u,d,f){let g=u.clippingPlanes,v=u.clipIntersection,p=u.clipShadows,m=i.get(u);if(!s||g===null||g.length===0||r&&!p)r?h(null):c();else{let y=r?0:n,R=y*4,b=m.clippingState||null;l.value=b,b=h(g,d,R,f);for(let A=0;A!==R;++A)b[A]=t[A];m.clippingState=b,this.numIntersection=v?this.numPlanes:0,this.numPlanes+=y}};function c(){l.value!==t&&(l.value=t,l.needsUpdate=n>0),e.numPlanes=n,e.numIntersection=0}function h(u,d,f,g){let v=u!==null?u.length:0,p=null;if(v!==0){if(p=l.value,g!==!0||p===null){let m=f+v*4,y=d.matrixWorldInverse;a.getNormalMatrix(y),(p===null||p.length<m)&&(p=new Float32Array(m));for(let R=0,b=f;R!==v;++R,b+=4)o.copy(u[R]).applyMatrix4(y,a),o.normal.toArray(p,b),p[b+3]=o.constant}l.value=p,l.needsUpdate=!0}return e.numPlanes=v,e.numIntersection=0,p}}var Ca=class extends Kn{constructor(e=1,t={}){super(e,e,t),this.isWebGLCubeRenderTarget=!0;let n={width:e,height:e,depth:1},s=[n,n,n,n,n,n];this.texture=new ca(s),this._setTextureOptions(t),this.texture.isRenderTargetTexture=!0}fromEquirectangularTexture(e,t){this.texture.type=t.type,this.texture.colorSpace=t.colorSpace,this.texture.generateMipmaps=t.generateMipmaps,this.texture.minFilter=t.minFilter,this.texture.magFilter=t.magFilter;let n={uniforms:{tEquirect:{value:null}},vertexShader:`

				varying vec3 vWorldDirection;

				vec3 transformDirection( in vec3 dir, in mat4 matrix ) {

					return normalize( ( matrix * vec4( dir, 0.0 ) ).xyz );

				}

				void main() {

					vWorldDirection = transformDirection( position, modelMatrix );

					#include <begin_vertex>
					#include <project_vertex>

				}
			`,fragmentShader:`

				uniform sampler2D tEquirect;

				varying vec3 vWorldDirection;

				#include <common>

				void main() {

					vec3 direction = normalize( vWorldDirection );

					vec2 sampleUV = equirectUv( direction );

					gl_FragColor = texture2D( tEquirect, sampleUV );

				}
			`},s=new ws(5,5,5),r=new Wt({name:"CubemapFromEquirect",uniforms:Er(n.uniforms),vertexShader:n.vertexShader,fragmentShader:n.fragmentShader,side:Jn,blending:br});r.uniforms.tEquirect.value=t;let o=new Bt(s,r),a=t.minFilter;return t.minFilter===vi&&(t.minFilter=Fn),new go(1,10,this).update(e,o),t.minFilter=a,o.geometry.dispose(),o.material.dispose(),this}clear(e,t=!0,n=!0,s=!0){let r=e.getRenderTarget();for(let o=0;o<6;o++)e.setRenderTarget(this,o),e.clear(t,n,s);e.setRenderTarget(r)}},lm=256,nb=3,ib=20,Im=256,Lm=16,sb=3,rb=new k,ob=new xt,qc=class i{constructor(e){this._renderer=e,this._cubeSize=0,this._sourceTarget=null,this._cubeCamera=new go(1,10,null),this._boxMesh=new Bt(new ws(5,5,5),null),this._cubemapMaterial=null,this._equirectMaterial=null,this._blurMaterial=null,this._ggxMaterial=null,this._integrationMaterial=null}fromScene(e,t=0,n=.1,s=100,r={}){let{size:o=256,position:a=rb}=r,l=this._renderer;this._setSize(o);let c=this._allocateTarget(),h=this._getSourceTarget(!0);t>0&&(h.texture.mipmapsAutoUpdate=!1);let u=l.autoClear,d=l.autoClearColor,f=l.autoClearDepth,g=l.autoClearStencil,v=e.background;l.autoClear=!0,l.autoClearColor=!0,l.autoClearDepth=!0,l.autoClearStencil=!0,v===null&&(e.background=l.getClearColor(ob));let p=new go(n,s,h);return p.position.copy(a),p.update(l,e),l.autoClear=u,l.autoClearColor=d,l.autoClearDepth=f,l.autoClearStencil=g,e.background=v,t>0&&(h.texture.mipmapsAutoUpdate=!0,this._blur(c,t)),this._applyPMREM(c),c}fromEquirectangular(e,t=null){return this._fromTexture(e,t)}fromCubemap(e,t=null){return this._fromTexture(e,t)}compileCubemapShader(){this._cubemapMaterial===null&&(this._cubemapMaterial=um(),this._compileMaterial(this._cubemapMaterial))}compileEquirectangularShader(){this._equirectMaterial===null&&(this._equirectMaterial=hm(),this._compileMaterial(this._equirectMaterial))}dispose(){this._sourceTarget!==null&&this._sourceTarget.dispose(),this._cubemapMaterial!==null&&this._cubemapMaterial.dispose(),this._equirectMaterial!==null&&this._equirectMaterial.dispose(),this._blurMaterial!==null&&this._blurMaterial.dispose(),this._ggxMaterial!==null&&this._ggxMaterial.dispose(),this._integrationMaterial!==null&&this._integrationMaterial.dispose(),this._boxMesh.geometry.dispose()}static lodToRoughness(e,t){return t>0?1-Math.sqrt(1-e/t):0}_setSize(e){this._cubeSize=Math.max(lm,im(e))}_fromTexture(e,t){e.mapping===Mr||e.mapping===_o?this._setSize(e.image.length===0?lm:e.image[0].width||e.image[0].image.width):this._setSize(e.image.width/4);let n=t||this._allocateTarget();return this._textureToCubemap(e),this._applyPMREM(n),n}_allocateTarget(){let e=this._cubeSize,t=cm(e,!1,!1),n=Math.log2(e)-nb;for(let s=0;s<=n;s++)t.texture.mipmaps.push({width:e>>s,height:e>>s});return t.texture.name="PMREM",t.texture.isPMREMTexture=!0,t}_getSourceTarget(e=!1){let t=this._cubeSize,n=this._sourceTarget;return(n===null||n.width!==t||e&&n.depthBuffer===!1)&&(n!==null&&n.dispose(),this._sourceTarget=cm(t,!0,e)),this._sourceTarget}_compileMaterial(e){this._boxMesh.material=e,this._renderer.compile(this._boxMesh,this._cubeCamera.children[0])}_renderCube(e,t,n){let s=this._boxMesh,r=this._cubeCamera;s.material=n,r.renderTarget=e,r.activeMipmapLevel=t;let o=e.width>>t;e.viewport.set(0,0,o,o),r.update(this._renderer,s),e.viewport.set(0,0,e.width,e.height)}_textureToCubemap(e){let t;e.mapping===Mr||e.mapping===_o?(this._cubemapMaterial===null&&(this._cubemapMaterial=um()),t=this._cubemapMaterial,t.uniforms.flipEnvMap.value=e.isRenderTargetTexture===!1?-1:1):(this._equirectMaterial===null&&(this._equirectMaterial=hm()),t=this._equirectMaterial),t.uniforms.envMap.value=e,this._renderCube(this._getSourceTarget(),0,t)}_applyPMREM(e){this._ggxMaterial===null&&(this._ggxMaterial=ab(),this._integrationMaterial=lb());let t=this._cubeSize,n=e.texture.mipmaps.length-1,s=this._ggxMaterial.uniforms;s.envMap.value=this._sourceTarget.texture;let r=this._integrationMaterial.uniforms;r.envMap.value=this._sourceTarget.texture,r.sourceLod.value=Math.log2(t/Lm);for(let o=0;o<=n;o++){let a=i.lodToRoughness(o,n);if(o>n-sb)r.roughness.value=a,this._renderCube(e,o,this._integrationMaterial);else{let l=a>0?Math.log2(t)+.5*Math.log2(6/(Im*Math.pow(a,4)))+.5:0;s.roughness.value=a,s.lodBias.value=l,this._renderCube(e,o,this._ggxMaterial)}}}_blur(e,t){this._blurMaterial===null&&(this._blurMaterial=cb());let n=this._blurMaterial,s=n.uniforms,r=this._sourceTarget;s.sigma.value=Math.min(t,Math.PI)/Math.SQRT2,s.envMap.value=r.texture,this._renderCube(e,0,n),s.envMap.value=e.texture,this._renderCube(r,0,n)}};function cm(i,e,t){return new Ca(i,{minFilter:vi,generateMipmaps:e,type:Vi,colorSpace:mr,depthBuffer:t})}function Pa(i,e,t){return new Wt({name:i,uniforms:e,vertexShader:dt.cube_vert,fragmentShader:t,side:Jn,blending:br,depthTest:!1,depthWrite:!1})}function ab(){return Pa("PMREMGGXConvolution",{envMap:{value:null},roughness:{value:0},lodBias:{value:0}},`

		#define GGX_SAMPLES ${Im}u

		varying vec3 vWorldDirection;

		uniform samplerCube envMap;
		uniform float roughness;
		uniform float lodBias;

		#include <common>

		// Van der Corput radical inverse
		float radicalInverse_VdC( uint bits ) {

			bits = ( bits << 16u ) | ( bits >> 16u );
			bits = ( ( bits & 0x55555555u ) << 1u ) | ( ( bits & 0xAAAAAAAAu ) >> 1u );
			bits = ( ( bits & 0x33333333u ) << 2u ) | ( ( bits & 0xCCCCCCCCu ) >> 2u );
			bits = ( ( bits & 0x0F0F0F0Fu ) << 4u ) | ( ( bits & 0xF0F0F0F0u ) >> 4u );
			bits = ( ( bits & 0x00FF00FFu ) << 8u ) | ( ( bits & 0xFF00FF00u ) >> 8u );
			return float( bits ) * 2.3283064365386963e-10; // / 0x100000000

		}

		// Hammersley sequence
		vec2 hammersley( uint i, uint N ) {

			return vec2( float( i ) / float( N ), radicalInverse_VdC( i ) );

		}

		void main() {

			vec3 N = normalize( vWorldDirection );

			// For very low roughness, just sample the environment directly
			if ( roughness < 0.001 ) {

				gl_FragColor = vec4( textureLod( envMap, N, 0.0 ).rgb, 1.0 );
				return;

			}

			float alpha = roughness * roughness;
			float alpha2 = alpha * alpha;

			// Tangent space basis for VNDF sampling
			vec3 up = abs( N.z ) < 0.999 ? vec3( 0.0, 0.0, 1.0 ) : vec3( 1.0, 0.0, 0.0 );
			vec3 tangent = normalize( cross( up, N ) );
			vec3 bitangent = cross( N, tangent );

			vec3 prefilteredColor = vec3( 0.0 );
			float totalWeight = 0.0;

			for ( uint i = 0u; i < GGX_SAMPLES; i ++ ) {

				vec2 Xi = hammersley( i, GGX_SAMPLES );

				// With V = N, sample the reflected direction directly.
				float invQ = 1.0 / ( 1.0 - Xi.x + alpha2 * Xi.x );
				float NdotL = ( 1.0 - Xi.x - alpha2 * Xi.x ) * invQ;

				if ( NdotL > 0.0 ) {

					float phi = 2.0 * PI * Xi.y;
					float sinTheta = 2.0 * alpha * sqrt( Xi.x * ( 1.0 - Xi.x ) ) * invQ;
					vec3 L = N * NdotL + ( tangent * cos( phi ) + bitangent * sin( phi ) ) * sinTheta;

					// Match the source mip to the sample's solid angle. The terms
					// independent of the sample are precomputed in lodBias.
					float d = alpha2 * invQ;
					float lod = max( log2( d ) + lodBias, 0.0 );

					// Weight by NdotL for the split-sum approximation
					prefilteredColor += textureLod( envMap, L, lod ).rgb * NdotL;
					totalWeight += NdotL;

				}

			}

			gl_FragColor = vec4( prefilteredColor / totalWeight, 1.0 );

		}
	`)}function lb(){return Pa("PMREMGGXIntegration",{envMap:{value:null},roughness:{value:0},sourceLod:{value:0},sourceSize:{value:Lm}},`

		varying vec3 vWorldDirection;

		uniform samplerCube envMap;
		uniform float roughness;
		uniform float sourceLod;
		uniform int sourceSize;

		void main() {

			vec3 N = normalize( vWorldDirection );

			float alpha = roughness * roughness;
			float alpha2 = alpha * alpha;

			float texelSize = 2.0 / float( sourceSize );

			vec3 prefilteredColor = vec3( 0.0 );
			float totalWeight = 0.0;

			// Pair opposite texels: only the one in N's hemisphere contributes.
			for ( int face = 0; face < 3; face ++ ) {

				for ( int y = 0; y < sourceSize; y ++ ) {

					for ( int x = 0; x < sourceSize; x ++ ) {

						vec2 uv = ( vec2( x, y ) + 0.5 ) * texelSize - 1.0;
						vec3 texelDirection = face == 0 ? vec3( 1.0, uv ) : ( face == 1 ? vec3( uv.x, 1.0, uv.y ) : vec3( uv, 1.0 ) );

						float invDistance = inversesqrt( 1.0 + dot( uv, uv ) );
						float NdotL = dot( N, texelDirection );
						texelDirection *= NdotL < 0.0 ? - 1.0 : 1.0;
						NdotL = abs( NdotL ) * invDistance;

						// With V = N, NdotH squared is ( 1 + NdotL ) / 2. Common factors
						// in the GGX distribution and texel solid angle cancel when normalized.
						float d = 1.0 + alpha2 + ( alpha2 - 1.0 ) * NdotL;
						float weight = NdotL * invDistance * invDistance * invDistance / ( d * d );

						prefilteredColor += textureLod( envMap, texelDirection, sourceLod ).rgb * weight;
						totalWeight += weight;

					}

				}

			}

			gl_FragColor = vec4( prefilteredColor / totalWeight, 1.0 );

		}
	`)}function cb(){return Pa("PMREMSphericalGaussianBlur",{envMap:{value:null},sigma:{value:0}},`

		#define SAMPLES ${ib}
		#define GOLDEN_ANGLE 2.39996322973

		varying vec3 vWorldDirection;

		uniform samplerCube envMap;
		uniform float sigma;

		#include <common>

		void main() {

			vec3 outputDirection = normalize( vWorldDirection );

			vec3 up = abs( outputDirection.z ) < 0.999 ? vec3( 0.0, 0.0, 1.0 ) : vec3( 1.0, 0.0, 0.0 );
			vec3 tangent = normalize( cross( up, outputDirection ) );
			vec3 bitangent = cross( outputDirection, tangent );

			// Truncate the kernel at three standard deviations or at the antipode.
			float thetaMax = min( 3.0 * sigma, PI );
			float truncation = 1.0 - exp( - 0.5 * thetaMax * thetaMax / ( sigma * sigma ) );

			vec3 accumColor = vec3( 0.0 );
			float accumWeight = 0.0;

			for ( int i = 0; i < SAMPLES; i ++ ) {

				// Stratified inverse-CDF sampling of the Gaussian, placed on a golden-angle spiral.
				float stratum = ( float( i ) + 0.5 ) / float( SAMPLES );
				float theta = sigma * sqrt( - 2.0 * log( 1.0 - stratum * truncation ) );
				float phi = float( i ) * GOLDEN_ANGLE;

				vec3 offset = cos( phi ) * tangent + sin( phi ) * bitangent;
				vec3 sampleDirection = cos( theta ) * outputDirection + sin( theta ) * offset;

				// Correct the planar sample density to solid angle.
				float weight = sin( theta ) / theta;

				accumColor += weight * textureLod( envMap, sampleDirection, 0.0 ).rgb;
				accumWeight += weight;

			}

			gl_FragColor = vec4( accumColor / accumWeight, 1.0 );

		}
	`)}function hm(){return Pa("PMREMEquirectangularToCubemap",{envMap:{value:null}},`

		varying vec3 vWorldDirection;

		uniform sampler2D envMap;

		#include <common>

		void main() {

			// Average four subpixel samples to preserve small, bright features.
			vec3 direction = normalize( vWorldDirection );
			vec3 dx = dFdx( direction ) * 0.25;
			vec3 dy = dFdy( direction ) * 0.25;

			vec3 color = textureLod( envMap, equirectUv( normalize( direction - dx - dy ) ), 0.0 ).rgb;
			color += textureLod( envMap, equirectUv( normalize( direction + dx - dy ) ), 0.0 ).rgb;
			color += textureLod( envMap, equirectUv( normalize( direction - dx + dy ) ), 0.0 ).rgb;
			color += textureLod( envMap, equirectUv( normalize( direction + dx + dy ) ), 0.0 ).rgb;
			gl_FragColor = vec4( color * 0.25, 1.0 );

		}
	`)}function um(){return Pa("PMREMCubemapToCubemap",{envMap:{value:null},flipEnvMap:{value:-1}},`

		varying vec3 vWorldDirection;

		uniform samplerCube envMap;
		uniform float flipEnvMap;

		void main() {

			gl_FragColor = vec4( textureCube( envMap, vec3( flipEnvMap * vWorldDirection.x, vWorldDirection.yz ) ).rgb, 1.0 );

		}
	`)}function hb(i){let e=new WeakMap,t=new WeakMap,n=null;function s(d,f=!1){return d==null?null:f?o(d):r(d)}function r(d){if(d&&d.isTexture){let f=d.mapping;if(f===sc||f===rc)if(e.has(d)){let g=e.get(d).texture;return a(g,d.mapping)}else{let g=d.image;if(g&&g.height>0){let v=new Ca(g.height);return v.fromEquirectangularTexture(i,d),e.set(d,v),d.addEventListener("dispose",c),a(v.texture,d.mapping)}else return null}}return d}function o(d){if(d&&d.isTexture&&d.isPMREMTexture!==!0){let f=d.mapping,g=f===sc||f===rc,v=f===Mr||f===_o;if(g||v){let p=t.get(d),m=p!==void 0?p.texture.pmremVersion:0;if(d.isRenderTargetTexture&&d.pmremVersion!==m)return n===null&&(n=new qc(i)),p=g?n.fromEquirectangular(d,p):n.fromCubemap(d,p),p.texture.pmremVersion=d.pmremVersion,t.set(d,p),p.texture;if(p!==void 0)return p.texture;{let y=d.image;return g&&y&&y.height>0||v&&y&&l(y)?(n===null&&(n=new qc(i)),p=g?n.fromEquirectangular(d):n.fromCubemap(d),p.texture.pmremVersion=d.pmremVersion,t.set(d,p),d.addEventListener("dispose",h),p.texture):null}}}return d}function a(d,f){return f===sc?d.mapping=Mr:f===rc&&(d.mapping=_o),d}function l(d){let f=0,g=6;for(let v=0;v<g;v++)d[v]!==void 0&&f++;return f===g}function c(d){let f=d.target;f.removeEventListener("dispose",c);let g=e.get(f);g!==void 0&&(e.delete(f),g.dispose())}function h(d){let f=d.target;f.removeEventListener("dispose",h);let g=t.get(f);g!==void 0&&(t.delete(f),g.dispose())}function u(){e=new WeakMap,t=new WeakMap,n!==null&&(n.dispose(),n=null)}return{get:s,dispose:u}}function ub(i){let e={};function t(n){if(e[n]!==void 0)return e[n];let s=i.getExtension(n);return e[n]=s,s}return{has:function(n){return t(n)!==null},init:function(){t("EXT_color_buffer_float"),t("WEBGL_clip_cull_distance"),t("OES_texture_float_linear"),t("EXT_color_buffer_half_float"),t("WEBGL_multisampled_render_to_texture"),t("WEBGL_render_shared_exponent")},get:function(n){let s=t(n);return s===null&&jo("WebGLRenderer: "+n+" extension not supported."),s}}}function db(i,e,t,n){let s={},r=new WeakMap,o=new FinalizationRegistry(g=>delete s[g]);function a(g){l(g.target)}function l(g){g.index!==null&&e.remove(g.index);for(let p in g.attributes)e.remove(g.attributes[p]);g.removeEventListener("dispose",a),delete s[g.id],o.unregister(g);let v=r.get(g);v&&(e.remove(v),r.delete(g)),n.releaseStatesOfGeometry(g),g.isInstancedBufferGeometry===!0&&delete g._maxInstanceCount,t.memory.geometries--}function c(g,v){return s[v.id]!==void 0||(v.addEventListener("dispose",a),s[v.id]=new WeakRef(v),o.register(v,v.id,v),t.memory.geometries++),v}function h(g){let v=g.attributes;for(let p in v)e.update(v[p],i.ARRAY_BUFFER)}function u(g){let v=g.index,p=g.attributes.position,m=0;if(p===void 0)return;let y=v!==null?v.array.length:p.array.length/3-1,R=p.count>=65535?aa:oa,b=new R(Math.ceil(y/3)*6,1),A=b.array;if(v!==null){let _=v.array;m=v.version;for(let T=0,O=0;T<y;T+=3){let I=_[T+0],L=_[T+1],H=_[T+2];A[O++]=I,A[O++]=L,A[O++]=L,A[O++]=H,A[O++]=H,A[O++]=I}}else{m=p.version;for(let _=0,T=0;_<y;_+=3){let O=_+0,I=_+1,L=_+2;A[T++]=O,A[T++]=I,A[T++]=I,A[T++]=L,A[T++]=L,A[T++]=O}}b.version=m;let E=r.get(g);E&&e.remove(E),r.set(g,b)}function d(g){let v=r.get(g);if(v){let p=g.index;p!==null&&v.version<p.version&&u(g)}else u(g);return r.get(g)}function f(){for(let g in s){let v=s[g].deref();v!==void 0&&l(v)}}return{get:c,update:h,getWireframeAttribute:d,dispose:f}}function fb(i,e,t){let n;function s(u){n=u}let r,o;function a(u){r=u.type,o=u.bytesPerElement}function l(u,d){i.drawElements(n,d,r,u*o),t.update(d,n,1)}function c(u,d,f){f!==0&&(i.drawElementsInstanced(n,d,r,u*o,f),t.update(d,n,f))}function h(u,d,f){if(f===0)return;e.get("WEBGL_multi_draw").multiDrawElementsWEBGL(n,d,0,r,u,0,f);let v=0;for(let p=0;p<f;p++)v+=d[p];t.update(v,n,1)}this.setMode=s,this.setIndex=a,this.render=l,this.renderInstances=c,this.renderMultiDraw=h}function pb(i){let e={geometries:0,textures:0},t={frame:0,calls:0,triangles:0,points:0,lines:0};function n(r,o,a){switch(t.calls++,o){case i.TRIANGLES:t.triangles+=a*(r/3);break;case i.LINES:t.lines+=a*(r/2);break;case i.LINE_STRIP:t.lines+=a*(r-1);break;case i.LINE_LOOP:t.lines+=a*r;break;case i.POINTS:t.points+=a*r;break;default:Qe("WebGLInfo: Unknown draw mode:",o);break}}function s(){t.calls=0,t.triangles=0,t.points=0,t.lines=0}return{memory:e,render:t,programs:null,autoReset:!0,reset:s,update:n}}function mb(i,e,t){let n=new WeakMap,s=new en;function r(o,a,l){let c=o.morphTargetInfluences,h=a.morphAttributes.position||a.morphAttributes.normal||a.morphAttributes.color,u=h!==void 0?h.length:0,d=n.get(a);if(d===void 0||d.count!==u){let O=function(){_.dispose(),n.delete(a),a.removeEventListener("dispose",O)};d!==void 0&&d.texture.dispose();let f=a.morphAttributes.position!==void 0,g=a.morphAttributes.normal!==void 0,v=a.morphAttributes.color!==void 0,p=a.morphAttributes.position||[],m=a.morphAttributes.normal||[],y=a.morphAttributes.color||[],R=0;f===!0&&(R=1),g===!0&&(R=2),v===!0&&(R=3);let b=a.attributes.position.count*R,A=1;b>e.maxTextureSize&&(A=Math.ceil(b/e.maxTextureSize),b=e.maxTextureSize);let E=new Float32Array(b*A*4*u),_=new ia(E,b,A,u);_.type=ti,_.needsUpdate=!0;let T=R*4;for(let I=0;I<u;I++){let L=p[I],H=m[I],V=y[I],N=b*A*4*I;for(let X=0;X<L.count;X++){let $=X*T;f===!0&&(s.fromBufferAttribute(L,X),E[N+$+0]=s.x,E[N+$+1]=s.y,E[N+$+2]=s.z,E[N+$+3]=0),g===!0&&(s.fromBufferAttribute(H,X),E[N+$+4]=s.x,E[N+$+5]=s.y,E[N+$+6]=s.z,E[N+$+7]=0),v===!0&&(s.fromBufferAttribute(V,X),E[N+$+8]=s.x,E[N+$+9]=s.y,E[N+$+10]=s.z,E[N+$+11]=V.itemSize===4?s.w:1)}}d={count:u,texture:_,size:new vt(b,A)},n.set(a,d),a.addEventListener("dispose",O)}if(o.isInstancedMesh===!0&&o.morphTexture!==null)l.getUniforms().setValue(i,"morphTexture",o.morphTexture,t);else{let f=0;for(let v=0;v<c.length;v++)f+=c[v];let g=a.morphTargetsRelative?1:1-f;l.getUniforms().setValue(i,"morphTargetBaseInfluence",g),l.getUniforms().setValue(i,"morphTargetInfluences",c)}l.getUniforms().setValue(i,"morphTargetsTexture",d.texture,t),l.getUniforms().setValue(i,"morphTargetsTextureSize",d.size)}return{update:r}}function gb(i,e,t,n,s){let r=new WeakMap;function o(c){let h=s.render.frame,u=c.geometry,d=e.get(c,u);if(r.get(d)!==h&&(e.update(d),r.set(d,h)),c.isInstancedMesh&&(c.hasEventListener("dispose",l)===!1&&c.addEventListener("dispose",l),r.get(c)!==h&&(t.update(c.instanceMatrix,i.ARRAY_BUFFER),c.instanceColor!==null&&t.update(c.instanceColor,i.ARRAY_BUFFER),r.set(c,h))),c.isSkinnedMesh){let f=c.skeleton;r.get(f)!==h&&(f.update(),r.set(f,h))}return d}function a(){r=new WeakMap}function l(c){let h=c.target;h.removeEventListener("dispose",l),n.releaseStatesOfObject(h),t.remove(h.instanceMatrix),h.instanceColor!==null&&t.remove(h.instanceColor)}return{update:o,dispose:a}}var vb={[Ou]:"LINEAR_TONE_MAPPING",[Bu]:"REINHARD_TONE_MAPPING",[ku]:"CINEON_TONE_MAPPING",[zu]:"ACES_FILMIC_TONE_MAPPING",[Vu]:"AGX_TONE_MAPPING",[Gu]:"NEUTRAL_TONE_MAPPING",[Hu]:"CUSTOM_TONE_MAPPING"};function _b(i,e,t,n,s,r){let o=new Kn(e,t,{type:i,depthBuffer:s,stencilBuffer:r,samples:n?4:0,storeMultisampledDepthBuffer:!1,storeMultisampledStencilBuffer:!1,resolveDepthBuffer:!1,resolveStencilBuffer:!1}),a=null,l=null,c=null,h=new zt;h.setAttribute("position",new lt([-1,3,0,-1,-1,0,3,-1,0],3)),h.setAttribute("uv",new lt([0,2,0,0,2,0],2));let u=new Wl({uniforms:{tDiffuse:{value:null}},vertexShader:`
			precision highp float;

			uniform mat4 modelViewMatrix;
			uniform mat4 projectionMatrix;

			attribute vec3 position;
			attribute vec2 uv;

			varying vec2 vUv;

			void main() {
				vUv = uv;
				gl_Position = projectionMatrix * modelViewMatrix * vec4( position, 1.0 );
			}`,fragmentShader:`
			precision highp float;

			uniform sampler2D tDiffuse;

			varying vec2 vUv;

			#include <tonemapping_pars_fragment>
			#include <colorspace_pars_fragment>

			void main() {
				gl_FragColor = texture2D( tDiffuse, vUv );

				#ifdef LINEAR_TONE_MAPPING
					gl_FragColor.rgb = LinearToneMapping( gl_FragColor.rgb );
				#elif defined( REINHARD_TONE_MAPPING )
					gl_FragColor.rgb = ReinhardToneMapping( gl_FragColor.rgb );
				#elif defined( CINEON_TONE_MAPPING )
					gl_FragColor.rgb = CineonToneMapping( gl_FragColor.rgb );
				#elif defined( ACES_FILMIC_TONE_MAPPING )
					gl_FragColor.rgb = ACESFilmicToneMapping( gl_FragColor.rgb );
				#elif defined( AGX_TONE_MAPPING )
					gl_FragColor.rgb = AgXToneMapping( gl_FragColor.rgb );
				#elif defined( NEUTRAL_TONE_MAPPING )
					gl_FragColor.rgb = NeutralToneMapping( gl_FragColor.rgb );
				#elif defined( CUSTOM_TONE_MAPPING )
					gl_FragColor.rgb = CustomToneMapping( gl_FragColor.rgb );
				#endif

				#ifdef SRGB_TRANSFER
					gl_FragColor = sRGBTransferOETF( gl_FragColor );
				#endif
			}`,depthTest:!1,depthWrite:!1}),d=new Bt(h,u),f=new mo(-1,1,1,-1,0,1),g=null,v=null,p=!1,m,y=null,R=[],b=!1;this.setSize=function(A,E){o.setSize(A,E),a!==null&&a.setSize(A,E),l!==null&&l.setSize(A,E);for(let _=0;_<R.length;_++){let T=R[_];T.setSize&&T.setSize(A,E)}},this.setEffects=function(A){R=A,b=R.length>0&&R[0].isRenderPass===!0;let E=o.width,_=o.height;R.length>0&&a===null&&(a=new Kn(E,_,{type:Vi,depthBuffer:!1,stencilBuffer:!1}),l=new Kn(E,_,{type:Vi,depthBuffer:!1,stencilBuffer:!1}));let T=s===!0&&R.some(O=>O.needsDepthTexture===!0);T!==(o.depthTexture!==null)&&(T===!0&&c===null&&(c=new Hi(E,_),r===!0&&(c.format=As,c.type=wr)),o.dispose(),o.depthTexture=T?c:null,o.resolveDepthBuffer=T,o.storeMultisampledDepthBuffer=T);for(let O=0;O<R.length;O++){let I=R[O];I.setSize&&I.setSize(E,_),T&&I.needsDepthTexture===!0&&I.setDepthTexture&&I.setDepthTexture(c)}},this.begin=function(A,E){if(p||A.toneMapping===rs&&R.length===0)return!1;if(y=E,E!==null){let _=E.width,T=E.height;(o.width!==_||o.height!==T)&&this.setSize(_,T)}return b===!1&&A.setRenderTarget(o),m=A.toneMapping,A.toneMapping=rs,!0},this.hasRenderPass=function(){return b},this.end=function(A,E){A.toneMapping=m,p=!0;let _=o,T=a;for(let O=0;O<R.length;O++){let I=R[O];I.enabled!==!1&&(I.render(A,T,_,E),I.needsSwap!==!1&&(_=T,T=T===a?l:a))}if(g!==A.outputColorSpace||v!==A.toneMapping){g=A.outputColorSpace,v=A.toneMapping,u.defines={},gt.getTransfer(g)===Pt&&(u.defines.SRGB_TRANSFER="");let O=vb[v];O&&(u.defines[O]=""),u.needsUpdate=!0}u.uniforms.tDiffuse.value=_.texture,A.setRenderTarget(y),A.render(d,f),y=null,p=!1},this.isCompositing=function(){return p},this.dispose=function(){o.dispose(),a!==null&&a.dispose(),l!==null&&l.dispose(),h.dispose(),u.dispose()}}var Dm=new Un,Nm=new Hi(1,1),Fm=new ua(1),Um=new ia,Om=new Bl,Bm=new ca,dm=[],fm=[],pm=new Float32Array(16),mm=new Float32Array(9),gm=new Float32Array(4);function So(i,e,t){let n=i[0];if(n<=0||n>0)return i;let s=e*t,r=dm[s];if(r===void 0&&(r=new Float32Array(s),dm[s]=r),e!==0){n.toArray(r,0);for(let o=1,a=0;o!==e;++o)a+=t,i[o].toArray(r,a)}return r}function bn(i,e){if(i.length!==e.length)return!1;for(let t=0,n=i.length;t<n;t++)if(i[t]!==e[t])return!1;return!0}function Sn(i,e){for(let t=0,n=e.length;t<n;t++)i[t]=e[t]}function $c(i,e){let t=fm[e];t===void 0&&(t=new Int32Array(e),fm[e]=t);for(let n=0;n!==e;++n)t[n]=i.allocateTextureUnit();return t}function xb(i,e){let t=this.cache;t[0]!==e&&(i.uniform1f(this.addr,e),t[0]=e)}function yb(i,e){let t=this.cache;if(e.x!==void 0)(t[0]!==e.x||t[1]!==e.y)&&(i.uniform2f(this.addr,e.x,e.y),t[0]=e.x,t[1]=e.y);else{if(bn(t,e))return;i.uniform2fv(this.addr,e),Sn(t,e)}}function bb(i,e){let t=this.cache;if(e.x!==void 0)(t[0]!==e.x||t[1]!==e.y||t[2]!==e.z)&&(i.uniform3f(this.addr,e.x,e.y,e.z),t[0]=e.x,t[1]=e.y,t[2]=e.z);else if(e.r!==void 0)(t[0]!==e.r||t[1]!==e.g||t[2]!==e.b)&&(i.uniform3f(this.addr,e.r,e.g,e.b),t[0]=e.r,t[1]=e.g,t[2]=e.b);else{if(bn(t,e))return;i.uniform3fv(this.addr,e),Sn(t,e)}}function Sb(i,e){let t=this.cache;if(e.x!==void 0)(t[0]!==e.x||t[1]!==e.y||t[2]!==e.z||t[3]!==e.w)&&(i.uniform4f(this.addr,e.x,e.y,e.z,e.w),t[0]=e.x,t[1]=e.y,t[2]=e.z,t[3]=e.w);else{if(bn(t,e))return;i.uniform4fv(this.addr,e),Sn(t,e)}}function Mb(i,e){let t=this.cache,n=e.elements;if(n===void 0){if(bn(t,e))return;i.uniformMatrix2fv(this.addr,!1,e),Sn(t,e)}else{if(bn(t,n))return;gm.set(n),i.uniformMatrix2fv(this.addr,!1,gm),Sn(t,n)}}function wb(i,e){let t=this.cache,n=e.elements;if(n===void 0){if(bn(t,e))return;i.uniformMatrix3fv(this.addr,!1,e),Sn(t,e)}else{if(bn(t,n))return;mm.set(n),i.uniformMatrix3fv(this.addr,!1,mm),Sn(t,n)}}function Eb(i,e){let t=this.cache,n=e.elements;if(n===void 0){if(bn(t,e))return;i.uniformMatrix4fv(this.addr,!1,e),Sn(t,e)}else{if(bn(t,n))return;pm.set(n),i.uniformMatrix4fv(this.addr,!1,pm),Sn(t,n)}}function Tb(i,e){let t=this.cache;t[0]!==e&&(i.uniform1i(this.addr,e),t[0]=e)}function Ab(i,e){let t=this.cache;if(e.x!==void 0)(t[0]!==e.x||t[1]!==e.y)&&(i.uniform2i(this.addr,e.x,e.y),t[0]=e.x,t[1]=e.y);else{if(bn(t,e))return;i.uniform2iv(this.addr,e),Sn(t,e)}}function Rb(i,e){let t=this.cache;if(e.x!==void 0)(t[0]!==e.x||t[1]!==e.y||t[2]!==e.z)&&(i.uniform3i(this.addr,e.x,e.y,e.z),t[0]=e.x,t[1]=e.y,t[2]=e.z);else{if(bn(t,e))return;i.uniform3iv(this.addr,e),Sn(t,e)}}function Cb(i,e){let t=this.cache;if(e.x!==void 0)(t[0]!==e.x||t[1]!==e.y||t[2]!==e.z||t[3]!==e.w)&&(i.uniform4i(this.addr,e.x,e.y,e.z,e.w),t[0]=e.x,t[1]=e.y,t[2]=e.z,t[3]=e.w);else{if(bn(t,e))return;i.uniform4iv(this.addr,e),Sn(t,e)}}function Pb(i,e){let t=this.cache;t[0]!==e&&(i.uniform1ui(this.addr,e),t[0]=e)}function Ib(i,e){let t=this.cache;if(e.x!==void 0)(t[0]!==e.x||t[1]!==e.y)&&(i.uniform2ui(this.addr,e.x,e.y),t[0]=e.x,t[1]=e.y);else{if(bn(t,e))return;i.uniform2uiv(this.addr,e),Sn(t,e)}}function Lb(i,e){let t=this.cache;if(e.x!==void 0)(t[0]!==e.x||t[1]!==e.y||t[2]!==e.z)&&(i.uniform3ui(this.addr,e.x,e.y,e.z),t[0]=e.x,t[1]=e.y,t[2]=e.z);else{if(bn(t,e))return;i.uniform3uiv(this.addr,e),Sn(t,e)}}function Db(i,e){let t=this.cache;if(e.x!==void 0)(t[0]!==e.x||t[1]!==e.y||t[2]!==e.z||t[3]!==e.w)&&(i.uniform4ui(this.addr,e.x,e.y,e.z,e.w),t[0]=e.x,t[1]=e.y,t[2]=e.z,t[3]=e.w);else{if(bn(t,e))return;i.uniform4uiv(this.addr,e),Sn(t,e)}}function Zc(i){return i.version===0&&(i.compareFunction=Qu,i.needsUpdate=!0),i}function Nb(i,e,t){let n=this.cache,s=t.allocateTextureUnit();n[0]!==s&&(i.uniform1i(this.addr,s),n[0]=s);let r;this.type===i.SAMPLER_2D_SHADOW?r=Zc(Nm):r=Dm,t.setTexture2D(e||r,s)}function Fb(i,e,t){let n=this.cache,s=t.allocateTextureUnit();n[0]!==s&&(i.uniform1i(this.addr,s),n[0]=s),t.setTexture3D(e||Om,s)}function Ub(i,e,t){let n=this.cache,s=t.allocateTextureUnit();n[0]!==s&&(i.uniform1i(this.addr,s),n[0]=s);let r;this.type===i.SAMPLER_CUBE_SHADOW?r=Zc(Fm):r=Bm,t.setTextureCube(e||r,s)}function Ob(i,e,t){let n=this.cache,s=t.allocateTextureUnit();n[0]!==s&&(i.uniform1i(this.addr,s),n[0]=s),t.setTexture2DArray(e||Um,s)}function Bb(i){switch(i){case 5126:return xb;case 35664:return yb;case 35665:return bb;case 35666:return Sb;case 35674:return Mb;case 35675:return wb;case 35676:return Eb;case 5124:case 35670:return Tb;case 35667:case 35671:return Ab;case 35668:case 35672:return Rb;case 35669:case 35673:return Cb;case 5125:return Pb;case 36294:return Ib;case 36295:return Lb;case 36296:return Db;case 35678:case 36198:case 36298:case 36306:case 35682:return Nb;case 35679:case 36299:case 36307:return Fb;case 35680:case 36300:case 36308:case 36293:return Ub;case 36289:case 36303:case 36311:case 36292:return Ob}}function kb(i,e){i.uniform1fv(this.addr,e)}function zb(i,e){let t=So(e,this.size,2);i.uniform2fv(this.addr,t)}function Hb(i,e){let t=So(e,this.size,3);i.uniform3fv(this.addr,t)}function Vb(i,e){let t=So(e,this.size,4);i.uniform4fv(this.addr,t)}function Gb(i,e){let t=So(e,this.size,4);i.uniformMatrix2fv(this.addr,!1,t)}function Wb(i,e){let t=So(e,this.size,9);i.uniformMatrix3fv(this.addr,!1,t)}function Xb(i,e){let t=So(e,this.size,16);i.uniformMatrix4fv(this.addr,!1,t)}function qb(i,e){i.uniform1iv(this.addr,e)}function Yb(i,e){i.uniform2iv(this.addr,e)}function $b(i,e){i.uniform3iv(this.addr,e)}function Zb(i,e){i.uniform4iv(this.addr,e)}function Kb(i,e){i.uniform1uiv(this.addr,e)}function Jb(i,e){i.uniform2uiv(this.addr,e)}function jb(i,e){i.uniform3uiv(this.addr,e)}function Qb(i,e){i.uniform4uiv(this.addr,e)}function eS(i,e,t){let n=this.cache,s=e.length,r=$c(t,s);bn(n,r)||(i.uniform1iv(this.addr,r),Sn(n,r));let o;this.type===i.SAMPLER_2D_SHADOW?o=Zc(Nm):o=Dm;for(let a=0;a!==s;++a)t.setTexture2D(e[a]||o,r[a])}function tS(i,e,t){let n=this.cache,s=e.length,r=$c(t,s);bn(n,r)||(i.uniform1iv(this.addr,r),Sn(n,r));for(let o=0;o!==s;++o)t.setTexture3D(e[o]||Om,r[o])}function nS(i,e,t){let n=this.cache,s=e.length,r=$c(t,s);bn(n,r)||(i.uniform1iv(this.addr,r),Sn(n,r));let o;this.type===i.SAMPLER_CUBE_SHADOW?o=Zc(Fm):o=Bm;for(let a=0;a!==s;++a)t.setTextureCube(e[a]||o,r[a])}function iS(i,e,t){let n=this.cache,s=e.length,r=$c(t,s);bn(n,r)||(i.uniform1iv(this.addr,r),Sn(n,r));for(let o=0;o!==s;++o)t.setTexture2DArray(e[o]||Um,r[o])}function sS(i){switch(i){case 5126:return kb;case 35664:return zb;case 35665:return Hb;case 35666:return Vb;case 35674:return Gb;case 35675:return Wb;case 35676:return Xb;case 5124:case 35670:return qb;case 35667:case 35671:return Yb;case 35668:case 35672:return $b;case 35669:case 35673:return Zb;case 5125:return Kb;case 36294:return Jb;case 36295:return jb;case 36296:return Qb;case 35678:case 36198:case 36298:case 36306:case 35682:return eS;case 35679:case 36299:case 36307:return tS;case 35680:case 36300:case 36308:case 36293:return nS;case 36289:case 36303:case 36311:case 36292:return iS}}var cd=class{constructor(e,t,n){this.id=e,this.addr=n,this.cache=[],this.type=t.type,this.setValue=Bb(t.type)}},hd=class{constructor(e,t,n){this.id=e,this.addr=n,this.cache=[],this.type=t.type,this.size=t.size,this.setValue=sS(t.type)}},ud=class{constructor(e){this.id=e,this.seq=[],this.map={}}setValue(e,t,n){let s=this.seq;for(let r=0,o=s.length;r!==o;++r){let a=s[r];a.setValue(e,t[a.id],n)}}},ad=/(\w+)(\])?(\[|\.)?/g;function vm(i,e){i.seq.push(e),i.map[e.id]=e}function rS(i,e,t){let n=i.name,s=n.length;for(ad.lastIndex=0;;){let r=ad.exec(n),o=ad.lastIndex,a=r[1],l=r[2]==="]",c=r[3];if(l&&(a=a|0),c===void 0||c==="["&&o+2===s){vm(t,c===void 0?new cd(a,i,e):new hd(a,i,e));break}else{let u=t.map[a];u===void 0&&(u=new ud(a),vm(t,u)),t=u}}}var bo=class{constructor(e,t){this.seq=[],this.map={};let n=e.getProgramParameter(t,e.ACTIVE_UNIFORMS);for(let o=0;o<n;++o){let a=e.getActiveUniform(t,o),l=e.getUniformLocation(t,a.name);rS(a,l,this)}let s=[],r=[];for(let o of this.seq)o.type===e.SAMPLER_2D_SHADOW||o.type===e.SAMPLER_CUBE_SHADOW||o.type===e.SAMPLER_2D_ARRAY_SHADOW?s.push(o):r.push(o);s.length>0&&(this.seq=s.concat(r))}setValue(e,t,n,s){let r=this.map[t];r!==void 0&&r.setValue(e,n,s)}setOptional(e,t,n){let s=t[n];s!==void 0&&this.setValue(e,n,s)}static upload(e,t,n,s){for(let r=0,o=t.length;r!==o;++r){let a=t[r],l=n[a.id];l.needsUpdate!==!1&&a.setValue(e,l.value,s)}}static seqWithValue(e,t){let n=[];for(let s=0,r=e.length;s!==r;++s){let o=e[s];o.id in t&&n.push(o)}return n}};function _m(i,e,t){let n=i.createShader(e);return i.shaderSource(n,t),i.compileShader(n),n}var oS=37297,aS=0;function lS(i,e){let t=i.split(`
`),n=[],s=Math.max(e-6,0),r=Math.min(e+6,t.length);for(let o=s;o<r;o++){let a=o+1;n.push(`${a===e?">":" "} ${a}: ${t[o]}`)}return n.join(`
`)}var xm=new qe;function cS(i){gt._getMatrix(xm,gt.workingColorSpace,i);let e=`mat3( ${xm.elements.map(t=>t.toFixed(4))} )`;switch(gt.getTransfer(i)){case ea:return[e,"LinearTransferOETF"];case Pt:return[e,"sRGBTransferOETF"];default:return $e("WebGLProgram: Unsupported color space: ",i),[e,"LinearTransferOETF"]}}function ym(i,e,t){let n=i.getShaderParameter(e,i.COMPILE_STATUS),r=(i.getShaderInfoLog(e)||"").trim();if(n&&r==="")return"";let o=/ERROR: 0:(\d+)/.exec(r);if(o){let a=parseInt(o[1]);return t.toUpperCase()+`

`+r+`

`+lS(i.getShaderSource(e),a)}else return r}function hS(i,e){let t=cS(e);return[`vec4 ${i}( vec4 value ) {`,`	return ${t[1]}( vec4( ${t[0]} * value.rgb, value.a ) );`,"}"].join(`
`)}var uS={[Ou]:"Linear",[Bu]:"Reinhard",[ku]:"Cineon",[zu]:"ACESFilmic",[Vu]:"AgX",[Gu]:"Neutral",[Hu]:"Custom"};function dS(i,e){let t=uS[e];return t===void 0?($e("WebGLProgram: Unsupported toneMapping:",e),"vec3 "+i+"( vec3 color ) { return LinearToneMapping( color ); }"):"vec3 "+i+"( vec3 color ) { return "+t+"ToneMapping( color ); }"}var Xc=new k;function fS(){gt.getLuminanceCoefficients(Xc);let i=Xc.x.toFixed(4),e=Xc.y.toFixed(4),t=Xc.z.toFixed(4);return["float luminance( const in vec3 rgb ) {",`	const vec3 weights = vec3( ${i}, ${e}, ${t} );`,"	return dot( weights, rgb );","}"].join(`
`)}function pS(i){return[i.extensionClipCullDistance?"#extension GL_ANGLE_clip_cull_distance : require":"",i.extensionMultiDraw?"#extension GL_ANGLE_multi_draw : require":""].filter(Ra).join(`
`)}function mS(i){let e=[];for(let t in i){let n=i[t];n!==!1&&e.push("#define "+t+" "+n)}return e.join(`
`)}function gS(i,e){let t={},n=i.getProgramParameter(e,i.ACTIVE_ATTRIBUTES);for(let s=0;s<n;s++){let r=i.getActiveAttrib(e,s),o=r.name,a=1;r.type===i.FLOAT_MAT2&&(a=2),r.type===i.FLOAT_MAT3&&(a=3),r.type===i.FLOAT_MAT4&&(a=4),t[o]={type:r.type,location:i.getAttribLocation(e,o),locationSize:a}}return t}function Ra(i){return i!==""}function bm(i,e){let t=e.numSpotLightShadows+e.numSpotLightMaps-e.numSpotLightShadowsWithMaps;return i.replace(/NUM_SUN_LIGHTS/g,e.numSunLights).replace(/NUM_DIR_LIGHTS/g,e.numDirLights).replace(/NUM_SPOT_LIGHTS/g,e.numSpotLights).replace(/NUM_SPOT_LIGHT_MAPS/g,e.numSpotLightMaps).replace(/NUM_SPOT_LIGHT_COORDS/g,t).replace(/NUM_RECT_AREA_LIGHTS/g,e.numRectAreaLights).replace(/NUM_POINT_LIGHTS/g,e.numPointLights).replace(/NUM_HEMI_LIGHTS/g,e.numHemiLights).replace(/NUM_SUN_LIGHT_SHADOWS/g,e.numSunLightShadows).replace(/NUM_DIR_LIGHT_SHADOWS/g,e.numDirLightShadows).replace(/NUM_SPOT_LIGHT_SHADOWS_WITH_MAPS/g,e.numSpotLightShadowsWithMaps).replace(/NUM_SPOT_LIGHT_SHADOWS/g,e.numSpotLightShadows).replace(/NUM_POINT_LIGHT_SHADOWS/g,e.numPointLightShadows).replace(/NUM_LIGHT_PROBE_GRIDS/g,e.numLightProbeGrids)}function Sm(i,e){return i.replace(/NUM_CLIPPING_PLANES/g,e.numClippingPlanes).replace(/UNION_CLIPPING_PLANES/g,e.numClippingPlanes-e.numClipIntersection)}var vS=/^[ \t]*#include +<([\w\d./]+)>/gm;function dd(i){return i.replace(vS,_S)}function _S(i,e){let t=dt[e];if(t===void 0)throw new Error("THREE.WebGLProgram: Can not resolve #include <"+e+">");return dd(t)}var xS=/#pragma unroll_loop_start\s+for\s*\(\s*int\s+i\s*=\s*(\d+)\s*;\s*i\s*<\s*(\d+)\s*;\s*i\s*\+\+\s*\)\s*{([\s\S]+?)}\s+#pragma unroll_loop_end/g;function Mm(i){return i.replace(xS,yS)}function yS(i,e,t,n){let s="";for(let r=parseInt(e);r<parseInt(t);r++)s+=n.replace(/\[\s*i\s*\]/g,"[ "+r+" ]").replace(/UNROLLED_LOOP_INDEX/g,r);return s}function wm(i){let e=`precision ${i.precision} float;
	precision ${i.precision} int;
	precision ${i.precision} sampler2D;
	precision ${i.precision} samplerCube;
	precision ${i.precision} sampler3D;
	precision ${i.precision} sampler2DArray;
	precision ${i.precision} sampler2DShadow;
	precision ${i.precision} samplerCubeShadow;
	precision ${i.precision} sampler2DArrayShadow;
	precision ${i.precision} isampler2D;
	precision ${i.precision} isampler3D;
	precision ${i.precision} isamplerCube;
	precision ${i.precision} isampler2DArray;
	precision ${i.precision} usampler2D;
	precision ${i.precision} usampler3D;
	precision ${i.precision} usamplerCube;
	precision ${i.precision} usampler2DArray;
	`;return i.precision==="highp"?e+=`
#define HIGH_PRECISION`:i.precision==="mediump"?e+=`
#define MEDIUM_PRECISION`:i.precision==="lowp"&&(e+=`
#define LOW_PRECISION`),e}var bS={[ga]:"SHADOWMAP_TYPE_PCF",[vo]:"SHADOWMAP_TYPE_VSM"};function SS(i){return bS[i.shadowMapType]||"SHADOWMAP_TYPE_BASIC"}var MS={[_o]:"ENVMAP_MODE_REFRACTION"};function wS(i){return i.envMap===!1?"ENVMAP_MODE_REFLECTION":MS[i.envMapMode]||"ENVMAP_MODE_REFLECTION"}var ES={[Uu]:"ENVMAP_BLENDING_MULTIPLY",[Hp]:"ENVMAP_BLENDING_MIX",[Vp]:"ENVMAP_BLENDING_ADD"};function TS(i){return i.envMap===!1?"ENVMAP_BLENDING_NONE":ES[i.combine]||"ENVMAP_BLENDING_NONE"}function AS(i,e,t,n){let s=i.getContext(),r=t.defines,o=t.vertexShader,a=t.fragmentShader,l=SS(t),c=t.envMapPMREM===!0?"ENVMAP_TYPE_PMREM":"ENVMAP_TYPE_CUBE",h=wS(t),u=TS(t),d=pS(t),f=mS(r),g=s.createProgram(),v,p,m=t.glslVersion?"#version "+t.glslVersion+`
`:"";t.isRawShaderMaterial?(v=["#define SHADER_TYPE "+t.shaderType,"#define SHADER_NAME "+t.shaderName,f].filter(Ra).join(`
`),v.length>0&&(v+=`
`),p=["#define SHADER_TYPE "+t.shaderType,"#define SHADER_NAME "+t.shaderName,f].filter(Ra).join(`
`),p.length>0&&(p+=`
`)):(v=[wm(t),"#define SHADER_TYPE "+t.shaderType,"#define SHADER_NAME "+t.shaderName,f,t.extensionClipCullDistance?"#define USE_CLIP_DISTANCE":"",t.batching?"#define USE_BATCHING":"",t.batchingColor?"#define USE_BATCHING_COLOR":"",t.instancing?"#define USE_INSTANCING":"",t.instancingColor?"#define USE_INSTANCING_COLOR":"",t.instancingMorph?"#define USE_INSTANCING_MORPH":"",t.useFog&&t.fog?"#define USE_FOG":"",t.useFog&&t.fogExp2?"#define FOG_EXP2":"",t.map?"#define USE_MAP":"",t.envMap?"#define USE_ENVMAP":"",t.envMap?"#define "+h:"",t.lightMap?"#define USE_LIGHTMAP":"",t.aoMap?"#define USE_AOMAP":"",t.bumpMap?"#define USE_BUMPMAP":"",t.normalMap?"#define USE_NORMALMAP":"",t.normalMapObjectSpace?"#define USE_NORMALMAP_OBJECTSPACE":"",t.normalMapTangentSpace?"#define USE_NORMALMAP_TANGENTSPACE":"",t.displacementMap?"#define USE_DISPLACEMENTMAP":"",t.emissiveMap?"#define USE_EMISSIVEMAP":"",t.anisotropy?"#define USE_ANISOTROPY":"",t.anisotropyMap?"#define USE_ANISOTROPYMAP":"",t.clearcoatMap?"#define USE_CLEARCOATMAP":"",t.clearcoatRoughnessMap?"#define USE_CLEARCOAT_ROUGHNESSMAP":"",t.clearcoatNormalMap?"#define USE_CLEARCOAT_NORMALMAP":"",t.diffuseRoughnessMap?"#define USE_DIFFUSE_ROUGHNESSMAP":"",t.iridescenceMap?"#define USE_IRIDESCENCEMAP":"",t.iridescenceThicknessMap?"#define USE_IRIDESCENCE_THICKNESSMAP":"",t.specularMap?"#define USE_SPECULARMAP":"",t.specularColorMap?"#define USE_SPECULAR_COLORMAP":"",t.specularIntensityMap?"#define USE_SPECULAR_INTENSITYMAP":"",t.roughnessMap?"#define USE_ROUGHNESSMAP":"",t.metalnessMap?"#define USE_METALNESSMAP":"",t.alphaMap?"#define USE_ALPHAMAP":"",t.alphaHash?"#define USE_ALPHAHASH":"",t.transmission?"#define USE_TRANSMISSION":"",t.transmissionMap?"#define USE_TRANSMISSIONMAP":"",t.thicknessMap?"#define USE_THICKNESSMAP":"",t.sheenColorMap?"#define USE_SHEEN_COLORMAP":"",t.sheenRoughnessMap?"#define USE_SHEEN_ROUGHNESSMAP":"",t.mapUv?"#define MAP_UV "+t.mapUv:"",t.alphaMapUv?"#define ALPHAMAP_UV "+t.alphaMapUv:"",t.lightMapUv?"#define LIGHTMAP_UV "+t.lightMapUv:"",t.aoMapUv?"#define AOMAP_UV "+t.aoMapUv:"",t.emissiveMapUv?"#define EMISSIVEMAP_UV "+t.emissiveMapUv:"",t.bumpMapUv?"#define BUMPMAP_UV "+t.bumpMapUv:"",t.normalMapUv?"#define NORMALMAP_UV "+t.normalMapUv:"",t.displacementMapUv?"#define DISPLACEMENTMAP_UV "+t.displacementMapUv:"",t.metalnessMapUv?"#define METALNESSMAP_UV "+t.metalnessMapUv:"",t.roughnessMapUv?"#define ROUGHNESSMAP_UV "+t.roughnessMapUv:"",t.anisotropyMapUv?"#define ANISOTROPYMAP_UV "+t.anisotropyMapUv:"",t.clearcoatMapUv?"#define CLEARCOATMAP_UV "+t.clearcoatMapUv:"",t.clearcoatNormalMapUv?"#define CLEARCOAT_NORMALMAP_UV "+t.clearcoatNormalMapUv:"",t.clearcoatRoughnessMapUv?"#define CLEARCOAT_ROUGHNESSMAP_UV "+t.clearcoatRoughnessMapUv:"",t.diffuseRoughnessMapUv?"#define DIFFUSE_ROUGHNESSMAP_UV "+t.diffuseRoughnessMapUv:"",t.iridescenceMapUv?"#define IRIDESCENCEMAP_UV "+t.iridescenceMapUv:"",t.iridescenceThicknessMapUv?"#define IRIDESCENCE_THICKNESSMAP_UV "+t.iridescenceThicknessMapUv:"",t.sheenColorMapUv?"#define SHEEN_COLORMAP_UV "+t.sheenColorMapUv:"",t.sheenRoughnessMapUv?"#define SHEEN_ROUGHNESSMAP_UV "+t.sheenRoughnessMapUv:"",t.specularMapUv?"#define SPECULARMAP_UV "+t.specularMapUv:"",t.specularColorMapUv?"#define SPECULAR_COLORMAP_UV "+t.specularColorMapUv:"",t.specularIntensityMapUv?"#define SPECULAR_INTENSITYMAP_UV "+t.specularIntensityMapUv:"",t.transmissionMapUv?"#define TRANSMISSIONMAP_UV "+t.transmissionMapUv:"",t.thicknessMapUv?"#define THICKNESSMAP_UV "+t.thicknessMapUv:"",t.vertexTangents&&t.flatShading===!1?"#define USE_TANGENT":"",t.vertexNormals?"#define HAS_NORMAL":"",t.vertexColors?"#define USE_COLOR":"",t.vertexAlphas?"#define USE_COLOR_ALPHA":"",t.vertexUv1s?"#define USE_UV1":"",t.vertexUv2s?"#define USE_UV2":"",t.vertexUv3s?"#define USE_UV3":"",t.pointsUvs?"#define USE_POINTS_UV":"",t.flatShading?"#define FLAT_SHADED":"",t.skinning?"#define USE_SKINNING":"",t.morphTargets?"#define USE_MORPHTARGETS":"",t.morphNormals&&t.flatShading===!1?"#define USE_MORPHNORMALS":"",t.morphColors?"#define USE_MORPHCOLORS":"",t.morphTargetsCount>0?"#define MORPHTARGETS_TEXTURE_STRIDE "+t.morphTextureStride:"",t.morphTargetsCount>0?"#define MORPHTARGETS_COUNT "+t.morphTargetsCount:"",t.doubleSided?"#define DOUBLE_SIDED":"",t.flipSided?"#define FLIP_SIDED":"",t.shadowMapEnabled?"#define USE_SHADOWMAP":"",t.shadowMapEnabled?"#define "+l:"",t.sizeAttenuation?"#define USE_SIZEATTENUATION":"",t.numLightProbes>0?"#define USE_LIGHT_PROBES":"",t.logarithmicDepthBuffer?"#define USE_LOGARITHMIC_DEPTH_BUFFER":"",t.reversedDepthBuffer?"#define USE_REVERSED_DEPTH_BUFFER":"","uniform mat4 modelMatrix;","uniform mat4 modelViewMatrix;","uniform mat4 projectionMatrix;","uniform mat4 viewMatrix;","uniform mat3 normalMatrix;","uniform vec3 cameraPosition;","uniform bool isOrthographic;","#ifdef USE_INSTANCING","	attribute mat4 instanceMatrix;","#endif","#ifdef USE_INSTANCING_COLOR","	attribute vec3 instanceColor;","#endif","#ifdef USE_INSTANCING_MORPH","	uniform sampler2D morphTexture;","#endif","attribute vec3 position;","attribute vec3 normal;","attribute vec2 uv;","#ifdef USE_UV1","	attribute vec2 uv1;","#endif","#ifdef USE_UV2","	attribute vec2 uv2;","#endif","#ifdef USE_UV3","	attribute vec2 uv3;","#endif","#ifdef USE_TANGENT","	attribute vec4 tangent;","#endif","#if defined( USE_COLOR_ALPHA )","	attribute vec4 color;","#elif defined( USE_COLOR )","	attribute vec3 color;","#endif","#ifdef USE_SKINNING","	attribute vec4 skinIndex;","	attribute vec4 skinWeight;","#endif",`
`].filter(Ra).join(`
`),p=[wm(t),"#define SHADER_TYPE "+t.shaderType,"#define SHADER_NAME "+t.shaderName,f,t.useFog&&t.fog?"#define USE_FOG":"",t.useFog&&t.fogExp2?"#define FOG_EXP2":"",t.alphaToCoverage?"#define ALPHA_TO_COVERAGE":"",t.map?"#define USE_MAP":"",t.matcap?"#define USE_MATCAP":"",t.envMap?"#define USE_ENVMAP":"",t.envMap?"#define "+c:"",t.envMap?"#define "+h:"",t.envMap?"#define "+u:"",t.envMapPMREM?"#define ENVMAP_MAX_LOD "+t.envMapMaxLod+".0":"",t.envMapPMREM?"#define ENVMAP_SIZE "+t.envMapSize+".0":"",t.lightMap?"#define USE_LIGHTMAP":"",t.aoMap?"#define USE_AOMAP":"",t.bumpMap?"#define USE_BUMPMAP":"",t.normalMap?"#define USE_NORMALMAP":"",t.normalMapObjectSpace?"#define USE_NORMALMAP_OBJECTSPACE":"",t.normalMapTangentSpace?"#define USE_NORMALMAP_TANGENTSPACE":"",t.packedNormalMap?"#define USE_PACKED_NORMALMAP":"",t.emissiveMap?"#define USE_EMISSIVEMAP":"",t.anisotropy?"#define USE_ANISOTROPY":"",t.anisotropyMap?"#define USE_ANISOTROPYMAP":"",t.clearcoat?"#define USE_CLEARCOAT":"",t.clearcoatMap?"#define USE_CLEARCOATMAP":"",t.clearcoatRoughnessMap?"#define USE_CLEARCOAT_ROUGHNESSMAP":"",t.clearcoatNormalMap?"#define USE_CLEARCOAT_NORMALMAP":"",t.diffuseRoughness?"#define USE_DIFFUSE_ROUGHNESS":"",t.diffuseRoughnessMap?"#define USE_DIFFUSE_ROUGHNESSMAP":"",t.dispersion?"#define USE_DISPERSION":"",t.retroreflection?"#define USE_RETROREFLECTION":"",t.iridescence?"#define USE_IRIDESCENCE":"",t.iridescenceMap?"#define USE_IRIDESCENCEMAP":"",t.iridescenceThicknessMap?"#define USE_IRIDESCENCE_THICKNESSMAP":"",t.specularMap?"#define USE_SPECULARMAP":"",t.specularColorMap?"#define USE_SPECULAR_COLORMAP":"",t.specularIntensityMap?"#define USE_SPECULAR_INTENSITYMAP":"",t.roughnessMap?"#define USE_ROUGHNESSMAP":"",t.metalnessMap?"#define USE_METALNESSMAP":"",t.alphaMap?"#define USE_ALPHAMAP":"",t.alphaTest?"#define USE_ALPHATEST":"",t.alphaHash?"#define USE_ALPHAHASH":"",t.sheen?"#define USE_SHEEN":"",t.sheenColorMap?"#define USE_SHEEN_COLORMAP":"",t.sheenRoughnessMap?"#define USE_SHEEN_ROUGHNESSMAP":"",t.transmission?"#define USE_TRANSMISSION":"",t.transmissionMap?"#define USE_TRANSMISSIONMAP":"",t.thicknessMap?"#define USE_THICKNESSMAP":"",t.vertexTangents&&t.flatShading===!1?"#define USE_TANGENT":"",t.vertexColors||t.instancingColor?"#define USE_COLOR":"",t.vertexAlphas||t.batchingColor?"#define USE_COLOR_ALPHA":"",t.vertexUv1s?"#define USE_UV1":"",t.vertexUv2s?"#define USE_UV2":"",t.vertexUv3s?"#define USE_UV3":"",t.pointsUvs?"#define USE_POINTS_UV":"",t.gradientMap?"#define USE_GRADIENTMAP":"",t.flatShading?"#define FLAT_SHADED":"",t.doubleSided?"#define DOUBLE_SIDED":"",t.flipSided?"#define FLIP_SIDED":"",t.shadowMapEnabled?"#define USE_SHADOWMAP":"",t.shadowMapEnabled?"#define "+l:"",t.premultipliedAlpha?"#define PREMULTIPLIED_ALPHA":"",t.numLightProbes>0?"#define USE_LIGHT_PROBES":"",t.decodeVideoTexture?"#define DECODE_VIDEO_TEXTURE":"",t.decodeVideoTextureEmissive?"#define DECODE_VIDEO_TEXTURE_EMISSIVE":"",t.logarithmicDepthBuffer?"#define USE_LOGARITHMIC_DEPTH_BUFFER":"",t.reversedDepthBuffer?"#define USE_REVERSED_DEPTH_BUFFER":"","uniform mat4 viewMatrix;","uniform vec3 cameraPosition;","uniform bool isOrthographic;",t.toneMapping!==rs?"#define TONE_MAPPING":"",t.toneMapping!==rs?dt.tonemapping_pars_fragment:"",t.toneMapping!==rs?dS("toneMapping",t.toneMapping):"",t.dithering?"#define DITHERING":"",t.opaque?"#define OPAQUE":"",dt.colorspace_pars_fragment,hS("linearToOutputTexel",t.outputColorSpace),fS(),t.useDepthPacking?"#define DEPTH_PACKING "+t.depthPacking:"",`
`].filter(Ra).join(`
`)),o=dd(o),o=bm(o,t),o=Sm(o,t),a=dd(a),a=bm(a,t),a=Sm(a,t),o=Mm(o),a=Mm(a),t.isRawShaderMaterial!==!0&&(m=`#version 300 es
`,v=[d,"#define attribute in","#define varying out","#define texture2D texture"].join(`
`)+`
`+v,p=["#define varying in",t.glslVersion===ed?"":"layout(location = 0) out highp vec4 pc_fragColor;",t.glslVersion===ed?"":"#define gl_FragColor pc_fragColor","#define gl_FragDepthEXT gl_FragDepth","#define texture2D texture","#define textureCube texture","#define texture2DProj textureProj","#define texture2DLodEXT textureLod","#define texture2DProjLodEXT textureProjLod","#define textureCubeLodEXT textureLod","#define texture2DGradEXT textureGrad","#define texture2DProjGradEXT textureProjGrad","#define textureCubeGradEXT textureGrad"].join(`
`)+`
`+p);let y=m+v+o,R=m+p+a,b=_m(s,s.VERTEX_SHADER,y),A=_m(s,s.FRAGMENT_SHADER,R);s.attachShader(g,b),s.attachShader(g,A),t.index0AttributeName!==void 0?s.bindAttribLocation(g,0,t.index0AttributeName):t.hasPositionAttribute===!0&&s.bindAttribLocation(g,0,"position"),s.linkProgram(g);function E(I){if(i.debug.checkShaderErrors){let L=s.getProgramInfoLog(g)||"",H=s.getShaderInfoLog(b)||"",V=s.getShaderInfoLog(A)||"",N=L.trim(),X=H.trim(),$=V.trim(),W=!0,ce=!0;if(s.getProgramParameter(g,s.LINK_STATUS)===!1)if(W=!1,typeof i.debug.onShaderError=="function")i.debug.onShaderError(s,g,b,A);else{let J=ym(s,b,"vertex"),Q=ym(s,A,"fragment");Qe("WebGLProgram: Shader Error "+s.getError()+" - VALIDATE_STATUS "+s.getProgramParameter(g,s.VALIDATE_STATUS)+`

Material Name: `+I.name+`
Material Type: `+I.type+`

Program Info Log: `+N+`
`+J+`
`+Q)}else N!==""?$e("WebGLProgram: Program Info Log:",N):(X===""||$==="")&&(ce=!1);ce&&(I.diagnostics={runnable:W,programLog:N,vertexShader:{log:X,prefix:v},fragmentShader:{log:$,prefix:p}})}s.deleteShader(b),s.deleteShader(A),_=new bo(s,g),T=gS(s,g)}let _;this.getUniforms=function(){return _===void 0&&E(this),_};let T;this.getAttributes=function(){return T===void 0&&E(this),T};let O=t.rendererExtensionParallelShaderCompile===!1;return this.isReady=function(){return O===!1&&(O=s.getProgramParameter(g,oS)),O},this.destroy=function(){n.releaseStatesOfProgram(this),s.deleteProgram(g),this.program=void 0},this.type=t.shaderType,this.name=t.shaderName,this.id=aS++,this.cacheKey=e,this.usedTimes=1,this.program=g,this.vertexShader=b,this.fragmentShader=A,this}var RS=0,fd=class{constructor(){this.shaderCache=new Map,this.materialCache=new Map}update(e,t,n){let s=this._getShaderCacheForMaterial(e);return s.has(t)===!1&&(s.add(t),t.usedTimes++),s.has(n)===!1&&(s.add(n),n.usedTimes++),this}remove(e){let t=this.materialCache.get(e);for(let n of t)n.usedTimes--,n.usedTimes===0&&this.shaderCache.delete(n.code);return this.materialCache.delete(e),this}getVertexShaderStage(e){return this._getShaderStage(e.vertexShader)}getFragmentShaderStage(e){return this._getShaderStage(e.fragmentShader)}dispose(){this.shaderCache.clear(),this.materialCache.clear()}_getShaderCacheForMaterial(e){let t=this.materialCache,n=t.get(e);return n===void 0&&(n=new Set,t.set(e,n)),n}_getShaderStage(e){let t=this.shaderCache,n=t.get(e);return n===void 0&&(n=new pd(e),t.set(e,n)),n}},pd=class{constructor(e){this.id=RS++,this.code=e,this.usedTimes=0}};function CS(i){return i===sr||i===wa||i===Ea}function PS(i,e,t,n,s,r){let o=new sa,a=new fd,l=new Set,c=[],h=new Map,u=n.logarithmicDepthBuffer,d={MeshDepthMaterial:"depth",MeshDistanceMaterial:"distance",MeshNormalMaterial:"normal",MeshBasicMaterial:"basic",MeshLambertMaterial:"lambert",MeshPhongMaterial:"phong",MeshToonMaterial:"toon",MeshStandardMaterial:"physical",MeshPhysicalMaterial:"physical",MeshMatcapMaterial:"matcap",LineBasicMaterial:"basic",LineDashedMaterial:"dashed",PointsMaterial:"points",ShadowMaterial:"shadow",SpriteMaterial:"sprite"};function f(_){return l.add(_),_===0?"uv":`uv${_}`}function g(_,T,O,I,L,H){let V=I.fog,N=L.geometry,X=_.isMeshStandardMaterial||_.isMeshLambertMaterial||_.isMeshPhongMaterial?I.environment:null,$=_.isMeshStandardMaterial||_.isMeshLambertMaterial&&!_.envMap||_.isMeshPhongMaterial&&!_.envMap,W=e.get(_.envMap||X,$),ce=d[_.type],J=n.precision;_.precision!==null&&(J=n.getMaxPrecision(_.precision),J!==_.precision&&$e("WebGLProgram.getParameters:",_.precision,"not supported, using",J,"instead."));let Q=N.morphAttributes.position||N.morphAttributes.normal||N.morphAttributes.color,se=Q!==void 0?Q.length:0,de=0;N.morphAttributes.position!==void 0&&(de=1),N.morphAttributes.normal!==void 0&&(de=2),N.morphAttributes.color!==void 0&&(de=3);let ue,ee,me,_e;if(ce){let Re=as[ce];ue=Re.vertexShader,ee=Re.fragmentShader}else{ue=_.vertexShader,ee=_.fragmentShader;let Re=a.getVertexShaderStage(_),ot=a.getFragmentShaderStage(_);a.update(_,Re,ot),me=Re.id,_e=ot.id}let Ae=i.getRenderTarget(),Se=i.state.buffers.depth.getReversed(),Ge=L.isInstancedMesh===!0,st=L.isBatchedMesh===!0,He=!!_.map,ft=!!_.matcap,ct=!!W,tt=ct&&W.isPMREMTexture===!0,Jt=!!_.aoMap,Gt=!!_.lightMap,un=!!_.bumpMap&&_.wireframe===!1,Ut=!!_.normalMap,En=!!_.displacementMap,wt=!!_.emissiveMap,xn=!!_.metalnessMap,tn=!!_.roughnessMap,dn=_.anisotropy>0,U=_.clearcoat>0,Ce=_.diffuseRoughness>0,Ye=_.dispersion>0,rt=_.retroreflectivity>0,Me=_.iridescence>0,kt=_.sheen>0,ze=_.transmission>0,Xe=dn&&!!_.anisotropyMap,C=U&&!!_.clearcoatMap,S=U&&!!_.clearcoatNormalMap,q=U&&!!_.clearcoatRoughnessMap,he=Ce&&!!_.diffuseRoughnessMap,oe=Me&&!!_.iridescenceMap,ve=Me&&!!_.iridescenceThicknessMap,xe=kt&&!!_.sheenColorMap,te=kt&&!!_.sheenRoughnessMap,ie=!!_.specularMap,pe=!!_.specularColorMap,F=!!_.specularIntensityMap,re=ze&&!!_.transmissionMap,ne=ze&&!!_.thicknessMap,we=!!_.gradientMap,ge=!!_.alphaMap,be=_.alphaTest>0,Ve=!!_.alphaHash,Ke=!!_.extensions,le=rs;_.toneMapped&&(Ae===null||Ae.isXRRenderTarget===!0)&&(le=i.toneMapping);let Oe=tt?W.isCompressedCubeTexture?W.image[0].mipmaps:W.mipmaps:null,Je={shaderID:ce,shaderType:_.type,shaderName:_.name,vertexShader:ue,fragmentShader:ee,defines:_.defines,customVertexShaderID:me,customFragmentShaderID:_e,isRawShaderMaterial:_.isRawShaderMaterial===!0,glslVersion:_.glslVersion,precision:J,batching:st,batchingColor:st&&L._colorsTexture!==null,instancing:Ge,instancingColor:Ge&&L.instanceColor!==null,instancingMorph:Ge&&L.morphTexture!==null,outputColorSpace:Ae===null?i.outputColorSpace:Ae.isXRRenderTarget===!0?Ae.texture.colorSpace:gt.workingColorSpace,alphaToCoverage:!!_.alphaToCoverage,map:He,matcap:ft,envMap:ct,envMapMode:ct&&W.mapping,envMapPMREM:tt,envMapMaxLod:tt?Oe.length-1:null,envMapSize:tt?Oe[0].width:null,aoMap:Jt,lightMap:Gt,bumpMap:un,normalMap:Ut,displacementMap:En,emissiveMap:wt,normalMapObjectSpace:Ut&&_.normalMapType===Xp,normalMapTangentSpace:Ut&&_.normalMapType===Ku,packedNormalMap:Ut&&_.normalMapType===Ku&&CS(_.normalMap.format),metalnessMap:xn,roughnessMap:tn,anisotropy:dn,anisotropyMap:Xe,clearcoat:U,clearcoatMap:C,clearcoatNormalMap:S,clearcoatRoughnessMap:q,diffuseRoughness:Ce,diffuseRoughnessMap:he,dispersion:Ye,retroreflection:rt,iridescence:Me,iridescenceMap:oe,iridescenceThicknessMap:ve,sheen:kt,sheenColorMap:xe,sheenRoughnessMap:te,specularMap:ie,specularColorMap:pe,specularIntensityMap:F,transmission:ze,transmissionMap:re,thicknessMap:ne,gradientMap:we,opaque:_.transparent===!1&&_.blending===ir&&_.alphaToCoverage===!1,alphaMap:ge,alphaTest:be,alphaHash:Ve,combine:_.combine,mapUv:He&&f(_.map.channel),aoMapUv:Jt&&f(_.aoMap.channel),lightMapUv:Gt&&f(_.lightMap.channel),bumpMapUv:un&&f(_.bumpMap.channel),normalMapUv:Ut&&f(_.normalMap.channel),displacementMapUv:En&&f(_.displacementMap.channel),emissiveMapUv:wt&&f(_.emissiveMap.channel),metalnessMapUv:xn&&f(_.metalnessMap.channel),roughnessMapUv:tn&&f(_.roughnessMap.channel),anisotropyMapUv:Xe&&f(_.anisotropyMap.channel),clearcoatMapUv:C&&f(_.clearcoatMap.channel),clearcoatNormalMapUv:S&&f(_.clearcoatNormalMap.channel),clearcoatRoughnessMapUv:q&&f(_.clearcoatRoughnessMap.channel),diffuseRoughnessMapUv:he&&f(_.diffuseRoughnessMap.channel),iridescenceMapUv:oe&&f(_.iridescenceMap.channel),iridescenceThicknessMapUv:ve&&f(_.iridescenceThicknessMap.channel),sheenColorMapUv:xe&&f(_.sheenColorMap.channel),sheenRoughnessMapUv:te&&f(_.sheenRoughnessMap.channel),specularMapUv:ie&&f(_.specularMap.channel),specularColorMapUv:pe&&f(_.specularColorMap.channel),specularIntensityMapUv:F&&f(_.specularIntensityMap.channel),transmissionMapUv:re&&f(_.transmissionMap.channel),thicknessMapUv:ne&&f(_.thicknessMap.channel),alphaMapUv:ge&&f(_.alphaMap.channel),vertexTangents:!!N.attributes.tangent&&(Ut||dn),vertexNormals:!!N.attributes.normal,vertexColors:_.vertexColors,vertexAlphas:_.vertexColors===!0&&!!N.attributes.color&&N.attributes.color.itemSize===4,pointsUvs:L.isPoints===!0&&!!N.attributes.uv&&(He||ge),fog:!!V,useFog:_.fog===!0,fogExp2:!!V&&V.isFogExp2,flatShading:_.wireframe===!1&&(_.flatShading===!0||N.attributes.normal===void 0&&Ut===!1&&(_.isMeshLambertMaterial||_.isMeshPhongMaterial||_.isMeshStandardMaterial||_.isMeshPhysicalMaterial)),sizeAttenuation:_.sizeAttenuation===!0,logarithmicDepthBuffer:u,reversedDepthBuffer:Se,skinning:L.isSkinnedMesh===!0,hasPositionAttribute:N.attributes.position!==void 0,morphTargets:N.morphAttributes.position!==void 0,morphNormals:N.morphAttributes.normal!==void 0,morphColors:N.morphAttributes.color!==void 0,morphTargetsCount:se,morphTextureStride:de,numSunLights:T.sun.length,numDirLights:T.directional.length,numPointLights:T.point.length,numSpotLights:T.spot.length,numSpotLightMaps:T.spotLightMap.length,numRectAreaLights:T.rectArea.length,numHemiLights:T.hemi.length,numSunLightShadows:T.sunShadowMap.length,numDirLightShadows:T.directionalShadowMap.length,numPointLightShadows:T.pointShadowMap.length,numSpotLightShadows:T.spotShadowMap.length,numSpotLightShadowsWithMaps:T.numSpotLightShadowsWithMaps,numLightProbes:T.numLightProbes,numLightProbeGrids:H.filter(Re=>Re.texture!==null).length,numClippingPlanes:r.numPlanes,numClipIntersection:r.numIntersection,dithering:_.dithering,shadowMapEnabled:i.shadowMap.enabled&&O.length>0,shadowMapType:i.shadowMap.type,toneMapping:le,decodeVideoTexture:He&&_.map.isVideoTexture===!0&&gt.getTransfer(_.map.colorSpace)===Pt,decodeVideoTextureEmissive:wt&&_.emissiveMap.isVideoTexture===!0&&gt.getTransfer(_.emissiveMap.colorSpace)===Pt,premultipliedAlpha:_.premultipliedAlpha,doubleSided:_.side===ln,flipSided:_.side===Jn,useDepthPacking:_.depthPacking>=0,depthPacking:_.depthPacking||0,index0AttributeName:_.index0AttributeName,extensionClipCullDistance:Ke&&_.extensions.clipCullDistance===!0&&t.has("WEBGL_clip_cull_distance"),extensionMultiDraw:(Ke&&_.extensions.multiDraw===!0||st)&&t.has("WEBGL_multi_draw"),rendererExtensionParallelShaderCompile:t.has("KHR_parallel_shader_compile"),customProgramCacheKey:_.customProgramCacheKey()};return Je.vertexUv1s=l.has(1),Je.vertexUv2s=l.has(2),Je.vertexUv3s=l.has(3),l.clear(),Je}function v(_){let T=[];if(_.shaderID?T.push(_.shaderID):(T.push(_.customVertexShaderID),T.push(_.customFragmentShaderID)),_.defines!==void 0)for(let O in _.defines)T.push(O),T.push(_.defines[O]);return _.isRawShaderMaterial===!1&&(p(T,_),m(T,_),T.push(i.outputColorSpace)),T.push(_.customProgramCacheKey),T.join()}function p(_,T){_.push(T.precision),_.push(T.outputColorSpace),_.push(T.envMapMode),_.push(T.envMapPMREM),_.push(T.envMapMaxLod),_.push(T.envMapSize),_.push(T.mapUv),_.push(T.alphaMapUv),_.push(T.lightMapUv),_.push(T.aoMapUv),_.push(T.bumpMapUv),_.push(T.normalMapUv),_.push(T.displacementMapUv),_.push(T.emissiveMapUv),_.push(T.metalnessMapUv),_.push(T.roughnessMapUv),_.push(T.anisotropyMapUv),_.push(T.clearcoatMapUv),_.push(T.clearcoatNormalMapUv),_.push(T.clearcoatRoughnessMapUv),_.push(T.diffuseRoughnessMapUv),_.push(T.iridescenceMapUv),_.push(T.iridescenceThicknessMapUv),_.push(T.sheenColorMapUv),_.push(T.sheenRoughnessMapUv),_.push(T.specularMapUv),_.push(T.specularColorMapUv),_.push(T.specularIntensityMapUv),_.push(T.transmissionMapUv),_.push(T.thicknessMapUv),_.push(T.combine),_.push(T.fogExp2),_.push(T.sizeAttenuation),_.push(T.morphTargetsCount),_.push(T.numSunLights),_.push(T.numDirLights),_.push(T.numPointLights),_.push(T.numSpotLights),_.push(T.numSpotLightMaps),_.push(T.numHemiLights),_.push(T.numRectAreaLights),_.push(T.numSunLightShadows),_.push(T.numDirLightShadows),_.push(T.numPointLightShadows),_.push(T.numSpotLightShadows),_.push(T.numSpotLightShadowsWithMaps),_.push(T.numLightProbes),_.push(T.numLightProbeGrids),_.push(T.shadowMapType),_.push(T.toneMapping),_.push(T.numClippingPlanes),_.push(T.numClipIntersection),_.push(T.depthPacking)}function m(_,T){o.disableAll(),T.instancing&&o.enable(0),T.instancingColor&&o.enable(1),T.instancingMorph&&o.enable(2),T.matcap&&o.enable(3),T.envMap&&o.enable(4),T.normalMapObjectSpace&&o.enable(5),T.normalMapTangentSpace&&o.enable(6),T.clearcoat&&o.enable(7),T.iridescence&&o.enable(8),T.alphaTest&&o.enable(9),T.vertexColors&&o.enable(10),T.vertexAlphas&&o.enable(11),T.vertexUv1s&&o.enable(12),T.vertexUv2s&&o.enable(13),T.vertexUv3s&&o.enable(14),T.vertexTangents&&o.enable(15),T.anisotropy&&o.enable(16),T.alphaHash&&o.enable(17),T.batching&&o.enable(18),T.dispersion&&o.enable(19),T.retroreflection&&o.enable(24),T.diffuseRoughness&&o.enable(25),T.batchingColor&&o.enable(20),T.gradientMap&&o.enable(21),T.packedNormalMap&&o.enable(22),T.vertexNormals&&o.enable(23),_.push(o.mask),o.disableAll(),T.fog&&o.enable(0),T.useFog&&o.enable(1),T.flatShading&&o.enable(2),T.logarithmicDepthBuffer&&o.enable(3),T.reversedDepthBuffer&&o.enable(4),T.skinning&&o.enable(5),T.morphTargets&&o.enable(6),T.morphNormals&&o.enable(7),T.morphColors&&o.enable(8),T.premultipliedAlpha&&o.enable(9),T.shadowMapEnabled&&o.enable(10),T.doubleSided&&o.enable(11),T.flipSided&&o.enable(12),T.useDepthPacking&&o.enable(13),T.dithering&&o.enable(14),T.transmission&&o.enable(15),T.sheen&&o.enable(16),T.opaque&&o.enable(17),T.pointsUvs&&o.enable(18),T.decodeVideoTexture&&o.enable(19),T.decodeVideoTextureEmissive&&o.enable(20),T.alphaToCoverage&&o.enable(21),T.numLightProbeGrids>0&&o.enable(22),T.hasPositionAttribute&&o.enable(23),_.push(o.mask)}function y(_){let T=d[_.type],O;if(T){let I=as[T];O=rm.clone(I.uniforms)}else O=_.uniforms;return O}function R(_,T){let O=h.get(T);return O!==void 0?++O.usedTimes:(O=new AS(i,T,_,s),c.push(O),h.set(T,O)),O}function b(_){if(--_.usedTimes===0){let T=c.indexOf(_);c[T]=c[c.length-1],c.pop(),h.delete(_.cacheKey),_.destroy()}}function A(_){a.remove(_)}function E(){a.dispose()}return{getParameters:g,getProgramCacheKey:v,getUniforms:y,acquireProgram:R,releaseProgram:b,releaseShaderCache:A,programs:c,dispose:E}}function IS(){let i=new WeakMap;function e(o){return i.has(o)}function t(o){let a=i.get(o);return a===void 0&&(a={},i.set(o,a)),a}function n(o){i.delete(o)}function s(o,a,l){i.get(o)[a]=l}function r(){i=new WeakMap}return{has:e,get:t,remove:n,update:s,dispose:r}}function LS(i,e){return i.groupOrder!==e.groupOrder?i.groupOrder-e.groupOrder:i.renderOrder!==e.renderOrder?i.renderOrder-e.renderOrder:i.material.id!==e.material.id?i.material.id-e.material.id:i.materialVariant!==e.materialVariant?i.materialVariant-e.materialVariant:i.z!==e.z?i.z-e.z:i.id-e.id}function Em(i,e){return i.groupOrder!==e.groupOrder?i.groupOrder-e.groupOrder:i.renderOrder!==e.renderOrder?i.renderOrder-e.renderOrder:i.z!==e.z?e.z-i.z:i.id-e.id}function Tm(){let i=[],e=0,t=[],n=[],s=[];function r(){e=0,t.length=0,n.length=0,s.length=0}function o(d){let f=0;return d.isInstancedMesh&&(f+=2),d.isSkinnedMesh&&(f+=1),f}function a(d,f,g,v,p,m){let y=i[e];return y===void 0?(y={id:d.id,object:d,geometry:f,material:g,materialVariant:o(d),groupOrder:v,renderOrder:d.renderOrder,z:p,group:m},i[e]=y):(y.id=d.id,y.object=d,y.geometry=f,y.material=g,y.materialVariant=o(d),y.groupOrder=v,y.renderOrder=d.renderOrder,y.z=p,y.group=m),e++,y}function l(d,f,g,v,p,m,y){y.reversedDepth===!0&&(p=-p);let R=a(d,f,g,v,p,m);g.transmission>0?n.push(R):g.transparent===!0?s.push(R):t.push(R)}function c(d,f,g,v,p,m){let y=a(d,f,g,v,p,m);g.transmission>0?n.unshift(y):g.transparent===!0?s.unshift(y):t.unshift(y)}function h(d,f){t.length>1&&t.sort(d||LS),n.length>1&&n.sort(f||Em),s.length>1&&s.sort(f||Em)}function u(){for(let d=e,f=i.length;d<f;d++){let g=i[d];if(g.id===null)break;g.id=null,g.object=null,g.geometry=null,g.material=null,g.group=null}}return{opaque:t,transmissive:n,transparent:s,init:r,push:l,unshift:c,finish:u,sort:h}}function DS(){let i=new WeakMap;function e(n,s){let r=i.get(n),o;return r===void 0?(o=new Tm,i.set(n,[o])):s>=r.length?(o=new Tm,r.push(o)):o=r[s],o}function t(){i=new WeakMap}return{get:e,dispose:t}}function NS(){let i={};return{get:function(e){if(i[e.id]!==void 0)return i[e.id];let t;switch(e.type){case"SunLight":case"DirectionalLight":t={direction:new k,color:new xt};break;case"SpotLight":t={position:new k,direction:new k,color:new xt,distance:0,coneCos:0,penumbraCos:0,decay:0};break;case"PointLight":t={position:new k,color:new xt,distance:0,decay:0};break;case"HemisphereLight":t={direction:new k,skyColor:new xt,groundColor:new xt};break;case"RectAreaLight":t={color:new xt,position:new k,halfWidth:new k,halfHeight:new k};break}return i[e.id]=t,t}}}function FS(){let i={};return{get:function(e){if(i[e.id]!==void 0)return i[e.id];let t;switch(e.type){case"SunLight":case"DirectionalLight":t={shadowIntensity:1,shadowBias:0,shadowNormalBias:0,shadowRadius:1,shadowMapSize:new vt};break;case"SpotLight":t={shadowIntensity:1,shadowBias:0,shadowNormalBias:0,shadowRadius:1,shadowMapSize:new vt};break;case"PointLight":t={shadowIntensity:1,shadowBias:0,shadowNormalBias:0,shadowRadius:1,shadowMapSize:new vt,shadowCameraNear:1,shadowCameraFar:1e3};break}return i[e.id]=t,t}}}var US=0;function OS(i,e){return(e.castShadow?2:0)-(i.castShadow?2:0)+(e.map?1:0)-(i.map?1:0)}function BS(i){let e=new NS,t=FS(),n={version:0,hash:{sunLength:-1,directionalLength:-1,pointLength:-1,spotLength:-1,rectAreaLength:-1,hemiLength:-1,numSunShadows:-1,numDirectionalShadows:-1,numPointShadows:-1,numSpotShadows:-1,numSpotMaps:-1,numLightProbes:-1},ambient:[0,0,0],probe:[],sun:[],sunShadow:[],sunShadowMap:[],sunShadowMatrix:[],sunShadowCascade:[],directional:[],directionalShadow:[],directionalShadowMap:[],directionalShadowMatrix:[],spot:[],spotLightMap:[],spotShadow:[],spotShadowMap:[],spotLightMatrix:[],rectArea:[],rectAreaLTC1:null,rectAreaLTC2:null,point:[],pointShadow:[],pointShadowMap:[],pointShadowMatrix:[],hemi:[],numSpotLightShadowsWithMaps:0,numLightProbes:0};for(let c=0;c<9;c++)n.probe.push(new k);let s=new k,r=new it,o=new it;function a(c){let h=0,u=0,d=0;for(let H=0;H<9;H++)n.probe[H].set(0,0,0);let f=0,g=0,v=0,p=0,m=0,y=0,R=0,b=0,A=0,E=0,_=0,T=0,O=0,I=0;c.sort(OS);for(let H=0,V=c.length;H<V;H++){let N=c[H],X=N.color,$=N.intensity,W=N.distance,ce=null;if(N.shadow&&N.shadow.map&&(N.shadow.map.texture.format===sr?ce=N.shadow.map.texture:ce=N.shadow.map.depthTexture||N.shadow.map.texture),N.isAmbientLight)h+=X.r*$,u+=X.g*$,d+=X.b*$;else if(N.isLightProbe){for(let J=0;J<9;J++)n.probe[J].addScaledVector(N.sh.coefficients[J],$);I++}else if(N.isSunLight){let J=e.get(N);if(J.color.copy(N.color).multiplyScalar(N.intensity),N.castShadow){let Q=N.shadow,se=t.get(N);se.shadowIntensity=Q.intensity,se.shadowBias=Q.bias,se.shadowNormalBias=Q.normalBias,se.shadowRadius=Q.radius,se.shadowMapSize.copy(Q.mapSize).multiply(Q.getFrameExtents()),n.sunShadow[g]=se,n.sunShadowMap[g]=ce;let de=Q.getViewportCount();for(let ue=0;ue<de;ue++)n.sunShadowMatrix[v+ue]=Q.getMatrix(ue),n.sunShadowCascade[v+ue]=Q._cascadeData[ue];v+=de,g++}n.sun[f]=J,f++}else if(N.isDirectionalLight){let J=e.get(N);if(J.color.copy(N.color).multiplyScalar(N.intensity),N.castShadow){let Q=N.shadow,se=t.get(N);se.shadowIntensity=Q.intensity,se.shadowBias=Q.bias,se.shadowNormalBias=Q.normalBias,se.shadowRadius=Q.radius,se.shadowMapSize=Q.mapSize,n.directionalShadow[p]=se,n.directionalShadowMap[p]=ce,n.directionalShadowMatrix[p]=N.shadow.matrix,A++}n.directional[p]=J,p++}else if(N.isSpotLight){let J=e.get(N);J.position.setFromMatrixPosition(N.matrixWorld),J.color.copy(X).multiplyScalar($),J.distance=W,J.coneCos=Math.cos(N.angle),J.penumbraCos=Math.cos(N.angle*(1-N.penumbra)),J.decay=N.decay,n.spot[y]=J;let Q=N.shadow;if(N.map&&(n.spotLightMap[T]=N.map,T++,Q.updateMatrices(N),N.castShadow&&O++),n.spotLightMatrix[y]=Q.matrix,N.castShadow){let se=t.get(N);se.shadowIntensity=Q.intensity,se.shadowBias=Q.bias,se.shadowNormalBias=Q.normalBias,se.shadowRadius=Q.radius,se.shadowMapSize=Q.mapSize,n.spotShadow[y]=se,n.spotShadowMap[y]=ce,_++}y++}else if(N.isRectAreaLight){let J=e.get(N);J.color.copy(X).multiplyScalar($),J.halfWidth.set(N.width*.5,0,0),J.halfHeight.set(0,N.height*.5,0),n.rectArea[R]=J,R++}else if(N.isPointLight){let J=e.get(N);if(J.color.copy(N.color).multiplyScalar(N.intensity),J.distance=N.distance,J.decay=N.decay,N.castShadow){let Q=N.shadow,se=t.get(N);se.shadowIntensity=Q.intensity,se.shadowBias=Q.bias,se.shadowNormalBias=Q.normalBias,se.shadowRadius=Q.radius,se.shadowMapSize=Q.mapSize,se.shadowCameraNear=Q.camera.near,se.shadowCameraFar=Q.camera.far,n.pointShadow[m]=se,n.pointShadowMap[m]=ce,n.pointShadowMatrix[m]=N.shadow.matrix,E++}n.point[m]=J,m++}else if(N.isHemisphereLight){let J=e.get(N);J.skyColor.copy(N.color).multiplyScalar($),J.groundColor.copy(N.groundColor).multiplyScalar($),n.hemi[b]=J,b++}}R>0&&(i.has("OES_texture_float_linear")===!0?(n.rectAreaLTC1=Le.LTC_FLOAT_1,n.rectAreaLTC2=Le.LTC_FLOAT_2):(n.rectAreaLTC1=Le.LTC_HALF_1,n.rectAreaLTC2=Le.LTC_HALF_2)),n.ambient[0]=h,n.ambient[1]=u,n.ambient[2]=d;let L=n.hash;(L.sunLength!==f||L.directionalLength!==p||L.pointLength!==m||L.spotLength!==y||L.rectAreaLength!==R||L.hemiLength!==b||L.numSunShadows!==g||L.numDirectionalShadows!==A||L.numPointShadows!==E||L.numSpotShadows!==_||L.numSpotMaps!==T||L.numLightProbes!==I)&&(n.sun.length=f,n.directional.length=p,n.spot.length=y,n.rectArea.length=R,n.point.length=m,n.hemi.length=b,n.sunShadow.length=g,n.sunShadowMap.length=g,n.sunShadowMatrix.length=v,n.sunShadowCascade.length=v,n.directionalShadow.length=A,n.directionalShadowMap.length=A,n.directionalShadowMatrix.length=A,n.pointShadow.length=E,n.pointShadowMap.length=E,n.pointShadowMatrix.length=E,n.spotShadow.length=_,n.spotShadowMap.length=_,n.spotLightMatrix.length=_+T-O,n.spotLightMap.length=T,n.numSpotLightShadowsWithMaps=O,n.numLightProbes=I,L.sunLength=f,L.directionalLength=p,L.pointLength=m,L.spotLength=y,L.rectAreaLength=R,L.hemiLength=b,L.numSunShadows=g,L.numDirectionalShadows=A,L.numPointShadows=E,L.numSpotShadows=_,L.numSpotMaps=T,L.numLightProbes=I,n.version=US++)}function l(c,h){let u=0,d=0,f=0,g=0,v=0,p=0,m=h.matrixWorldInverse;for(let y=0,R=c.length;y<R;y++){let b=c[y];if(b.isSunLight){let A=n.sun[u];A.direction.setFromMatrixPosition(b.matrixWorld),A.direction.transformDirection(m),u++}else if(b.isDirectionalLight){let A=n.directional[d];A.direction.setFromMatrixPosition(b.matrixWorld),s.setFromMatrixPosition(b.target.matrixWorld),A.direction.sub(s),A.direction.transformDirection(m),d++}else if(b.isSpotLight){let A=n.spot[g];A.position.setFromMatrixPosition(b.matrixWorld),A.position.applyMatrix4(m),A.direction.setFromMatrixPosition(b.matrixWorld),s.setFromMatrixPosition(b.target.matrixWorld),A.direction.sub(s),A.direction.transformDirection(m),g++}else if(b.isRectAreaLight){let A=n.rectArea[v];A.position.setFromMatrixPosition(b.matrixWorld),A.position.applyMatrix4(m),o.identity(),r.copy(b.matrixWorld),r.premultiply(m),o.extractRotation(r),A.halfWidth.set(b.width*.5,0,0),A.halfHeight.set(0,b.height*.5,0),A.halfWidth.applyMatrix4(o),A.halfHeight.applyMatrix4(o),v++}else if(b.isPointLight){let A=n.point[f];A.position.setFromMatrixPosition(b.matrixWorld),A.position.applyMatrix4(m),f++}else if(b.isHemisphereLight){let A=n.hemi[p];A.direction.setFromMatrixPosition(b.matrixWorld),A.direction.transformDirection(m),p++}}}return{setup:a,setupView:l,state:n}}function Am(i){let e=new BS(i),t=[],n=[],s=[];function r(u){h.camera=u,t.length=0,n.length=0,s.length=0}function o(u){u.isLightProbeGrid?s.push(u):t.push(u)}function a(u){n.push(u)}function l(){e.setup(t),s.sort((u,d)=>u.priority-d.priority||u.id-d.id)}function c(u){e.setupView(t,u)}let h={lightsArray:t,shadowsArray:n,lightProbeGridArray:s,camera:null,lights:e,transmissionRenderTarget:{},textureUnits:0};return{init:r,state:h,setupLights:l,setupLightsView:c,pushLight:o,pushShadow:a}}function kS(i){let e=new WeakMap;function t(s,r=0){let o=e.get(s),a;return o===void 0?(a=new Am(i),e.set(s,[a])):r>=o.length?(a=new Am(i),o.push(a)):a=o[r],a}function n(){e=new WeakMap}return{get:t,dispose:n}}var zS=`void main() {
	gl_Position = vec4( position, 1.0 );
}`,HS=`uniform sampler2D shadow_pass;
uniform vec2 resolution;
uniform float radius;
void main() {
	const float samples = float( VSM_SAMPLES );
	float mean = 0.0;
	float squared_mean = 0.0;
	float uvStride = samples <= 1.0 ? 0.0 : 2.0 / ( samples - 1.0 );
	float uvStart = samples <= 1.0 ? 0.0 : - 1.0;
	for ( float i = 0.0; i < samples; i ++ ) {
		float uvOffset = uvStart + i * uvStride;
		#ifdef HORIZONTAL_PASS
			vec2 distribution = texture2D( shadow_pass, ( gl_FragCoord.xy + vec2( uvOffset, 0.0 ) * radius ) / resolution ).rg;
			mean += distribution.x;
			squared_mean += distribution.y * distribution.y + distribution.x * distribution.x;
		#else
			float depth = texture2D( shadow_pass, ( gl_FragCoord.xy + vec2( 0.0, uvOffset ) * radius ) / resolution ).r;
			mean += depth;
			squared_mean += depth * depth;
		#endif
	}
	mean = mean / samples;
	squared_mean = squared_mean / samples;
	float std_dev = sqrt( max( 0.0, squared_mean - mean * mean ) );
	gl_FragColor = vec4( mean, std_dev, 0.0, 1.0 );
}`,VS=[new k(1,0,0),new k(-1,0,0),new k(0,1,0),new k(0,-1,0),new k(0,0,1),new k(0,0,-1)],GS=[new k(0,-1,0),new k(0,-1,0),new k(0,0,1),new k(0,0,-1),new k(0,-1,0),new k(0,-1,0)],Rm=new it,Aa=new k,ld=new k;function WS(i,e,t){let n=new vr,s=new vt,r=new vt,o=new en,a=new Xl,l=new ql,c={},h=t.maxTextureSize,u={[ss]:Jn,[Jn]:ss,[ln]:ln},d=new Wt({defines:{VSM_SAMPLES:8},uniforms:{shadow_pass:{value:null},resolution:{value:new vt},radius:{value:4}},vertexShader:zS,fragmentShader:HS}),f=d.clone();f.defines.HORIZONTAL_PASS=1;let g=new zt;g.setAttribute("position",new Nn(new Float32Array([-1,-1,.5,3,-1,.5,-1,3,.5]),3));let v=new Bt(g,d),p=this;this.enabled=!1,this.autoUpdate=!0,this.needsUpdate=!1,this.type=ga;let m=this.type;this.render=function(E,_,T){if(p.enabled===!1||p.autoUpdate===!1&&p.needsUpdate===!1||E.length===0)return;this.type===Sp&&($e("WebGLShadowMap: PCFSoftShadowMap has been removed. Using PCFShadowMap instead."),this.type=ga);let O=i.getRenderTarget(),I=i.getActiveCubeFace(),L=i.getActiveMipmapLevel(),H=i.state;H.setBlending(br),H.buffers.depth.getReversed()===!0?H.buffers.color.setClear(0,0,0,0):H.buffers.color.setClear(1,1,1,1),H.buffers.depth.setTest(!0),H.setScissorTest(!1);let V=m!==this.type;V&&_.traverse(function(N){N.material&&(Array.isArray(N.material)?N.material.forEach(X=>X.needsUpdate=!0):N.material.needsUpdate=!0)});for(let N=0,X=E.length;N<X;N++){let $=E[N],W=$.shadow;if(W===void 0){$e("WebGLShadowMap:",$,"has no shadow.");continue}if(W.autoUpdate===!1&&W.needsUpdate===!1)continue;s.copy(W.mapSize);let ce=W.getFrameExtents();s.multiply(ce),r.copy(W.mapSize),(s.x>h||s.y>h)&&(s.x>h&&(r.x=Math.floor(h/ce.x),s.x=r.x*ce.x,W.mapSize.x=r.x),s.y>h&&(r.y=Math.floor(h/ce.y),s.y=r.y*ce.y,W.mapSize.y=r.y));let J=i.state.buffers.depth.getReversed();if(W.camera._reversedDepth=J,W.map===null||V===!0){if(W.map!==null&&(W.map.depthTexture!==null&&(W.map.depthTexture.dispose(),W.map.depthTexture=null),W.map.dispose()),this.type===vo){if($.isPointLight){$e("WebGLShadowMap: VSM shadow maps are not supported for PointLights. Use PCF or BasicShadowMap instead.");continue}W.map=new Kn(s.x,s.y,{format:sr,type:Vi,minFilter:Fn,magFilter:Fn,generateMipmaps:!1}),W.map.texture.name=$.name+".shadowMap",W.map.depthTexture=new Hi(s.x,s.y,ti),W.map.depthTexture.name=$.name+".shadowMapDepth",W.map.depthTexture.format=Ss,W.map.depthTexture.compareFunction=null,W.map.depthTexture.minFilter=an,W.map.depthTexture.magFilter=an}else $.isPointLight?(W.map=new Ca(s.x),W.map.depthTexture=new ua(s.x,xi)):(W.map=new Kn(s.x,s.y),W.map.depthTexture=new Hi(s.x,s.y,xi)),W.map.depthTexture.name=$.name+".shadowMap",W.map.depthTexture.format=Ss,this.type===ga?(W.map.depthTexture.compareFunction=J?ju:Ju,W.map.depthTexture.minFilter=Fn,W.map.depthTexture.magFilter=Fn):(W.map.depthTexture.compareFunction=null,W.map.depthTexture.minFilter=an,W.map.depthTexture.magFilter=an);W.camera.updateProjectionMatrix()}W.map.isWebGLCubeRenderTarget!==!0&&(W.map.width!==s.x||W.map.height!==s.y)&&W.map.setSize(s.x,s.y);let Q=W.map.isWebGLCubeRenderTarget?6:W.getViewportCount();$.isPointLight!==!0&&W.updateMatrices($,T);let se=(W.camera.layers.mask&4294967294)!==0?W.camera.layers:T.layers;for(let de=0;de<Q;de++){let ue=W.getCamera(de);if($.isPointLight){let ee=W.camera,me=W.matrix,_e=$.distance||ee.far;_e!==ee.far&&(ee.far=_e,ee.updateProjectionMatrix()),Aa.setFromMatrixPosition($.matrixWorld),ee.position.copy(Aa),ld.copy(ee.position),ld.add(VS[de]),ee.up.copy(GS[de]),ee.lookAt(ld),ee.updateMatrixWorld(),me.makeTranslation(-Aa.x,-Aa.y,-Aa.z),Rm.multiplyMatrices(ee.projectionMatrix,ee.matrixWorldInverse),W._frustum.setFromProjectionMatrix(Rm,ee.coordinateSystem,ee.reversedDepth)}if(W.map.isWebGLCubeRenderTarget)i.setRenderTarget(W.map,de),i.clear();else{de===0&&(i.setRenderTarget(W.map),i.clear());let ee=W.getViewport(de);o.set(r.x*ee.x,r.y*ee.y,r.x*ee.z,r.y*ee.w),H.viewport(o)}n=W.getFrustum(de),b(_,T,ue,$,se,this.type)}W.isPointLightShadow!==!0&&this.type===vo&&y(W,T),W.needsUpdate=!1}m=this.type,p.needsUpdate=!1,i.setRenderTarget(O,I,L)};function y(E,_){let T=e.update(v);d.defines.VSM_SAMPLES!==E.blurSamples&&(d.defines.VSM_SAMPLES=E.blurSamples,f.defines.VSM_SAMPLES=E.blurSamples,d.needsUpdate=!0,f.needsUpdate=!0),E.mapPass===null?E.mapPass=new Kn(s.x,s.y,{format:sr,type:Vi}):(E.mapPass.width!==E.map.width||E.mapPass.height!==E.map.height)&&E.mapPass.setSize(E.map.width,E.map.height),d.uniforms.shadow_pass.value=E.map.depthTexture,d.uniforms.resolution.value.set(E.map.width,E.map.height),d.uniforms.radius.value=E.radius,i.setRenderTarget(E.mapPass),i.clear(),i.renderBufferDirect(_,null,T,d,v,null),f.uniforms.shadow_pass.value=E.mapPass.texture,f.uniforms.resolution.value.set(E.map.width,E.map.height),f.uniforms.radius.value=E.radius,i.setRenderTarget(E.map),i.clear(),i.renderBufferDirect(_,null,T,f,v,null)}function R(E,_,T,O){let I=null,L=T.isPointLight===!0?E.customDistanceMaterial:E.customDepthMaterial;if(L!==void 0)I=L;else if(I=T.isPointLight===!0?l:a,i.localClippingEnabled&&_.clipShadows===!0&&Array.isArray(_.clippingPlanes)&&_.clippingPlanes.length!==0||_.displacementMap&&_.displacementScale!==0||_.alphaMap&&_.alphaTest>0||_.map&&_.alphaTest>0||_.alphaToCoverage===!0){let H=I.uuid,V=_.uuid,N=c[H];N===void 0&&(N={},c[H]=N);let X=N[V];X===void 0&&(X=I.clone(),N[V]=X,_.addEventListener("dispose",A)),I=X}if(I.visible=_.visible,I.wireframe=_.wireframe,O===vo?I.side=_.shadowSide!==null?_.shadowSide:_.side:I.side=_.shadowSide!==null?_.shadowSide:u[_.side],I.alphaMap=_.alphaMap,I.alphaTest=_.alphaToCoverage===!0?.5:_.alphaTest,I.map=_.map,I.clipShadows=_.clipShadows,I.clippingPlanes=_.clippingPlanes,I.clipIntersection=_.clipIntersection,I.displacementMap=_.displacementMap,I.displacementScale=_.displacementScale,I.displacementBias=_.displacementBias,I.wireframeLinewidth=_.wireframeLinewidth,I.linewidth=_.linewidth,T.isPointLight===!0&&I.isMeshDistanceMaterial===!0){let H=i.properties.get(I);H.light=T}return I}function b(E,_,T,O,I,L){if(E.visible===!1)return;if(E.layers.test(I)&&(E.isMesh||E.isLine||E.isPoints)&&(E.castShadow||E.receiveShadow&&L===vo)&&(!E.frustumCulled||E.intersectsFrustum(n))){E.modelViewMatrix.multiplyMatrices(T.matrixWorldInverse,E.matrixWorld);let N=e.update(E),X=E.material;if(Array.isArray(X)){let $=N.groups;for(let W=0,ce=$.length;W<ce;W++){let J=$[W],Q=X[J.materialIndex];if(Q&&Q.visible){let se=R(E,Q,O,L);E.onBeforeShadow(i,E,_,T,N,se,J),i.renderBufferDirect(T,null,N,se,E,J),E.onAfterShadow(i,E,_,T,N,se,J)}}}else if(X.visible){let $=R(E,X,O,L);E.onBeforeShadow(i,E,_,T,N,$,null),i.renderBufferDirect(T,null,N,$,E,null),E.onAfterShadow(i,E,_,T,N,$,null)}}let V=E.children;for(let N=0,X=V.length;N<X;N++)b(V[N],_,T,O,I,L)}function A(E){E.target.removeEventListener("dispose",A);for(let T in c){let O=c[T],I=E.target.uuid;I in O&&(O[I].dispose(),delete O[I])}}}function XS(i,e){function t(){let F=!1,re=new en,ne=null,we=new en(0,0,0,0);return{setMask:function(ge){ne!==ge&&!F&&(i.colorMask(ge,ge,ge,ge),ne=ge)},setLocked:function(ge){F=ge},setClear:function(ge,be,Ve,Ke,le){le===!0&&(ge*=Ke,be*=Ke,Ve*=Ke),re.set(ge,be,Ve,Ke),we.equals(re)===!1&&(i.clearColor(ge,be,Ve,Ke),we.copy(re))},reset:function(){F=!1,ne=null,we.set(-1,0,0,0)}}}function n(){let F=!1,re=!1,ne=null,we=null,ge=null;return{setReversed:function(be){if(re!==be){let Ve=e.get("EXT_clip_control");be?Ve.clipControlEXT(Ve.LOWER_LEFT_EXT,Ve.ZERO_TO_ONE_EXT):Ve.clipControlEXT(Ve.LOWER_LEFT_EXT,Ve.NEGATIVE_ONE_TO_ONE_EXT),re=be;let Ke=ge;ge=null,this.setClear(Ke)}},getReversed:function(){return re},setTest:function(be){be?Se(i.DEPTH_TEST):Ge(i.DEPTH_TEST)},setMask:function(be){ne!==be&&!F&&(i.depthMask(be),ne=be)},setFunc:function(be){if(re&&(be=nm[be]),we!==be){switch(be){case Tl:i.depthFunc(i.NEVER);break;case Al:i.depthFunc(i.ALWAYS);break;case Rl:i.depthFunc(i.LESS);break;case oo:i.depthFunc(i.LEQUAL);break;case Cl:i.depthFunc(i.EQUAL);break;case Pl:i.depthFunc(i.GEQUAL);break;case Il:i.depthFunc(i.GREATER);break;case Ll:i.depthFunc(i.NOTEQUAL);break;default:i.depthFunc(i.LEQUAL)}we=be}},setLocked:function(be){F=be},setClear:function(be){ge!==be&&(ge=be,re&&(be=1-be),i.clearDepth(be))},reset:function(){F=!1,ne=null,we=null,ge=null,re=!1}}}function s(){let F=!1,re=null,ne=null,we=null,ge=null,be=null,Ve=null,Ke=null,le=null;return{setTest:function(Oe){F||(Oe?Se(i.STENCIL_TEST):Ge(i.STENCIL_TEST))},setMask:function(Oe){re!==Oe&&!F&&(i.stencilMask(Oe),re=Oe)},setFunc:function(Oe,Je,Re){(ne!==Oe||we!==Je||ge!==Re)&&(i.stencilFunc(Oe,Je,Re),ne=Oe,we=Je,ge=Re)},setOp:function(Oe,Je,Re){(be!==Oe||Ve!==Je||Ke!==Re)&&(i.stencilOp(Oe,Je,Re),be=Oe,Ve=Je,Ke=Re)},setLocked:function(Oe){F=Oe},setClear:function(Oe){le!==Oe&&(i.clearStencil(Oe),le=Oe)},reset:function(){F=!1,re=null,ne=null,we=null,ge=null,be=null,Ve=null,Ke=null,le=null}}}let r=new t,o=new n,a=new s,l={},c=new WeakMap,h={},u={},d={},f=new WeakMap,g=[],v=null,p=!1,m=null,y=null,R=null,b=null,A=null,E=null,_=null,T=new xt(0,0,0),O=0,I=!1,L=null,H=null,V=null,N=null,X=null,$=i.getParameter(i.MAX_COMBINED_TEXTURE_IMAGE_UNITS),W=!1,ce=0,J=i.getParameter(i.VERSION);J.indexOf("WebGL")!==-1?(ce=parseFloat(/^WebGL (\d)/.exec(J)[1]),W=ce>=1):J.indexOf("OpenGL ES")!==-1&&(ce=parseFloat(/^OpenGL ES (\d)/.exec(J)[1]),W=ce>=2);let Q=null,se={},de=i.getParameter(i.SCISSOR_BOX),ue=i.getParameter(i.VIEWPORT),ee=new en().fromArray(de),me=new en().fromArray(ue);function _e(F,re,ne,we){let ge=new Uint8Array(4),be=i.createTexture();i.bindTexture(F,be),i.texParameteri(F,i.TEXTURE_MIN_FILTER,i.NEAREST),i.texParameteri(F,i.TEXTURE_MAG_FILTER,i.NEAREST);for(let Ve=0;Ve<ne;Ve++)F===i.TEXTURE_3D||F===i.TEXTURE_2D_ARRAY?i.texImage3D(re,0,i.RGBA,1,1,we,0,i.RGBA,i.UNSIGNED_BYTE,ge):i.texImage2D(re+Ve,0,i.RGBA,1,1,0,i.RGBA,i.UNSIGNED_BYTE,ge);return be}let Ae={};Ae[i.TEXTURE_2D]=_e(i.TEXTURE_2D,i.TEXTURE_2D,1),Ae[i.TEXTURE_CUBE_MAP]=_e(i.TEXTURE_CUBE_MAP,i.TEXTURE_CUBE_MAP_POSITIVE_X,6),Ae[i.TEXTURE_2D_ARRAY]=_e(i.TEXTURE_2D_ARRAY,i.TEXTURE_2D_ARRAY,1,1),Ae[i.TEXTURE_3D]=_e(i.TEXTURE_3D,i.TEXTURE_3D,1,1),r.setClear(0,0,0,1),o.setClear(1),a.setClear(0),Se(i.DEPTH_TEST),o.setFunc(oo),un(!1),Ut(Iu),Se(i.CULL_FACE),Jt(br);function Se(F){h[F]!==!0&&(i.enable(F),h[F]=!0)}function Ge(F){h[F]!==!1&&(i.disable(F),h[F]=!1)}function st(F,re){return d[F]!==re?(i.bindFramebuffer(F,re),d[F]=re,F===i.DRAW_FRAMEBUFFER&&(d[i.FRAMEBUFFER]=re),F===i.FRAMEBUFFER&&(d[i.DRAW_FRAMEBUFFER]=re),!0):!1}function He(F,re){let ne=g,we=!1;if(F){ne=f.get(re),ne===void 0&&(ne=[],f.set(re,ne));let ge=F.textures;if(ne.length!==ge.length||ne[0]!==i.COLOR_ATTACHMENT0){for(let be=0,Ve=ge.length;be<Ve;be++)ne[be]=i.COLOR_ATTACHMENT0+be;ne.length=ge.length,we=!0}}else ne[0]!==i.BACK&&(ne[0]=i.BACK,we=!0);we&&i.drawBuffers(ne)}function ft(F){return v!==F?(i.useProgram(F),v=F,!0):!1}let ct={[Sr]:i.FUNC_ADD,[wp]:i.FUNC_SUBTRACT,[Ep]:i.FUNC_REVERSE_SUBTRACT};ct[Tp]=i.MIN,ct[Ap]=i.MAX;let tt={[Rp]:i.ZERO,[Cp]:i.ONE,[Pp]:i.SRC_COLOR,[Nu]:i.SRC_ALPHA,[Up]:i.SRC_ALPHA_SATURATE,[Np]:i.DST_COLOR,[Lp]:i.DST_ALPHA,[Ip]:i.ONE_MINUS_SRC_COLOR,[Fu]:i.ONE_MINUS_SRC_ALPHA,[Fp]:i.ONE_MINUS_DST_COLOR,[Dp]:i.ONE_MINUS_DST_ALPHA,[Op]:i.CONSTANT_COLOR,[Bp]:i.ONE_MINUS_CONSTANT_COLOR,[kp]:i.CONSTANT_ALPHA,[zp]:i.ONE_MINUS_CONSTANT_ALPHA};function Jt(F,re,ne,we,ge,be,Ve,Ke,le,Oe){if(F===br){p===!0&&(Ge(i.BLEND),p=!1);return}if(p===!1&&(Se(i.BLEND),p=!0),F!==Mp){if(F!==m||Oe!==I){if((y!==Sr||A!==Sr)&&(i.blendEquation(i.FUNC_ADD),y=Sr,A=Sr),Oe)switch(F){case ir:i.blendFuncSeparate(i.ONE,i.ONE_MINUS_SRC_ALPHA,i.ONE,i.ONE_MINUS_SRC_ALPHA);break;case va:i.blendFunc(i.ONE,i.ONE);break;case Lu:i.blendFuncSeparate(i.ZERO,i.ONE_MINUS_SRC_COLOR,i.ZERO,i.ONE);break;case Du:i.blendFuncSeparate(i.DST_COLOR,i.ONE_MINUS_SRC_ALPHA,i.ZERO,i.ONE);break;default:Qe("WebGLState: Invalid blending: ",F);break}else switch(F){case ir:i.blendFuncSeparate(i.SRC_ALPHA,i.ONE_MINUS_SRC_ALPHA,i.ONE,i.ONE_MINUS_SRC_ALPHA);break;case va:i.blendFuncSeparate(i.SRC_ALPHA,i.ONE,i.ONE,i.ONE);break;case Lu:Qe("WebGLState: SubtractiveBlending requires material.premultipliedAlpha = true");break;case Du:Qe("WebGLState: MultiplyBlending requires material.premultipliedAlpha = true");break;default:Qe("WebGLState: Invalid blending: ",F);break}R=null,b=null,E=null,_=null,T.set(0,0,0),O=0,m=F,I=Oe}return}ge=ge||re,be=be||ne,Ve=Ve||we,(re!==y||ge!==A)&&(i.blendEquationSeparate(ct[re],ct[ge]),y=re,A=ge),(ne!==R||we!==b||be!==E||Ve!==_)&&(i.blendFuncSeparate(tt[ne],tt[we],tt[be],tt[Ve]),R=ne,b=we,E=be,_=Ve),(Ke.equals(T)===!1||le!==O)&&(i.blendColor(Ke.r,Ke.g,Ke.b,le),T.copy(Ke),O=le),m=F,I=!1}function Gt(F,re){F.side===ln?Ge(i.CULL_FACE):Se(i.CULL_FACE);let ne=F.side===Jn;re&&(ne=!ne),un(ne),F.blending===ir&&F.transparent===!1?Jt(br):Jt(F.blending,F.blendEquation,F.blendSrc,F.blendDst,F.blendEquationAlpha,F.blendSrcAlpha,F.blendDstAlpha,F.blendColor,F.blendAlpha,F.premultipliedAlpha),o.setFunc(F.depthFunc),o.setTest(F.depthTest),o.setMask(F.depthWrite),r.setMask(F.colorWrite);let we=F.stencilWrite;a.setTest(we),we&&(a.setMask(F.stencilWriteMask),a.setFunc(F.stencilFunc,F.stencilRef,F.stencilFuncMask),a.setOp(F.stencilFail,F.stencilZFail,F.stencilZPass)),wt(F.polygonOffset,F.polygonOffsetFactor,F.polygonOffsetUnits),F.alphaToCoverage===!0?Se(i.SAMPLE_ALPHA_TO_COVERAGE):Ge(i.SAMPLE_ALPHA_TO_COVERAGE)}function un(F){L!==F&&(F?i.frontFace(i.CW):i.frontFace(i.CCW),L=F)}function Ut(F){F!==yp?(Se(i.CULL_FACE),F!==H&&(F===Iu?i.cullFace(i.BACK):F===bp?i.cullFace(i.FRONT):i.cullFace(i.FRONT_AND_BACK))):Ge(i.CULL_FACE),H=F}function En(F){F!==V&&(W&&i.lineWidth(F),V=F)}function wt(F,re,ne){F?(Se(i.POLYGON_OFFSET_FILL),(N!==re||X!==ne)&&(N=re,X=ne,o.getReversed()&&(re=-re,ne=-ne),i.polygonOffset(re,ne))):Ge(i.POLYGON_OFFSET_FILL)}function xn(F){F?Se(i.SCISSOR_TEST):Ge(i.SCISSOR_TEST)}function tn(F){F===void 0&&(F=i.TEXTURE0+$-1),Q!==F&&(i.activeTexture(F),Q=F)}function dn(F,re,ne){ne===void 0&&(Q===null?ne=i.TEXTURE0+$-1:ne=Q);let we=se[ne];we===void 0&&(we={type:void 0,texture:void 0},se[ne]=we),(we.type!==F||we.texture!==re)&&(Q!==ne&&(i.activeTexture(ne),Q=ne),i.bindTexture(F,re||Ae[F]),we.type=F,we.texture=re)}function U(){let F=se[Q];F!==void 0&&F.type!==void 0&&(i.bindTexture(F.type,null),F.type=void 0,F.texture=void 0)}function Ce(){try{i.compressedTexImage2D(...arguments)}catch(F){Qe("WebGLState:",F)}}function Ye(){try{i.compressedTexImage3D(...arguments)}catch(F){Qe("WebGLState:",F)}}function rt(){try{i.texSubImage2D(...arguments)}catch(F){Qe("WebGLState:",F)}}function Me(){try{i.texSubImage3D(...arguments)}catch(F){Qe("WebGLState:",F)}}function kt(){try{i.compressedTexSubImage2D(...arguments)}catch(F){Qe("WebGLState:",F)}}function ze(){try{i.compressedTexSubImage3D(...arguments)}catch(F){Qe("WebGLState:",F)}}function Xe(){try{i.texStorage2D(...arguments)}catch(F){Qe("WebGLState:",F)}}function C(){try{i.texStorage3D(...arguments)}catch(F){Qe("WebGLState:",F)}}function S(){try{i.texImage2D(...arguments)}catch(F){Qe("WebGLState:",F)}}function q(){try{i.texImage3D(...arguments)}catch(F){Qe("WebGLState:",F)}}function he(F){return u[F]!==void 0?u[F]:i.getParameter(F)}function oe(F,re){u[F]!==re&&(i.pixelStorei(F,re),u[F]=re)}function ve(F){ee.equals(F)===!1&&(i.scissor(F.x,F.y,F.z,F.w),ee.copy(F))}function xe(F){me.equals(F)===!1&&(i.viewport(F.x,F.y,F.z,F.w),me.copy(F))}function te(F,re){let ne=c.get(re);ne===void 0&&(ne=new WeakMap,c.set(re,ne));let we=ne.get(F);we===void 0&&(we=i.getUniformBlockIndex(re,F.name),i.uniformBlockBinding(re,we,we),ne.set(F,we))}function ie(F,re,ne){let ge=c.get(re).get(F);l[ge]!==ne&&(i.bindBufferBase(i.UNIFORM_BUFFER,ge,ne),l[ge]=ne)}function pe(){i.disable(i.BLEND),i.disable(i.CULL_FACE),i.disable(i.DEPTH_TEST),i.disable(i.POLYGON_OFFSET_FILL),i.disable(i.SCISSOR_TEST),i.disable(i.STENCIL_TEST),i.disable(i.SAMPLE_ALPHA_TO_COVERAGE),i.blendEquation(i.FUNC_ADD),i.blendFunc(i.ONE,i.ZERO),i.blendFuncSeparate(i.ONE,i.ZERO,i.ONE,i.ZERO),i.blendColor(0,0,0,0),i.colorMask(!0,!0,!0,!0),i.clearColor(0,0,0,0),i.depthMask(!0),i.depthFunc(i.LESS),o.setReversed(!1),i.clearDepth(1),i.stencilMask(4294967295),i.stencilFunc(i.ALWAYS,0,4294967295),i.stencilOp(i.KEEP,i.KEEP,i.KEEP),i.clearStencil(0),i.cullFace(i.BACK),i.frontFace(i.CCW),i.polygonOffset(0,0),i.activeTexture(i.TEXTURE0),i.bindFramebuffer(i.FRAMEBUFFER,null),i.bindFramebuffer(i.DRAW_FRAMEBUFFER,null),i.bindFramebuffer(i.READ_FRAMEBUFFER,null),i.useProgram(null),i.lineWidth(1),i.scissor(0,0,i.canvas.width,i.canvas.height),i.viewport(0,0,i.canvas.width,i.canvas.height),i.pixelStorei(i.PACK_ALIGNMENT,4),i.pixelStorei(i.UNPACK_ALIGNMENT,4),i.pixelStorei(i.UNPACK_FLIP_Y_WEBGL,!1),i.pixelStorei(i.UNPACK_PREMULTIPLY_ALPHA_WEBGL,!1),i.pixelStorei(i.UNPACK_COLORSPACE_CONVERSION_WEBGL,i.BROWSER_DEFAULT_WEBGL),i.pixelStorei(i.PACK_ROW_LENGTH,0),i.pixelStorei(i.PACK_SKIP_PIXELS,0),i.pixelStorei(i.PACK_SKIP_ROWS,0),i.pixelStorei(i.UNPACK_ROW_LENGTH,0),i.pixelStorei(i.UNPACK_IMAGE_HEIGHT,0),i.pixelStorei(i.UNPACK_SKIP_PIXELS,0),i.pixelStorei(i.UNPACK_SKIP_ROWS,0),i.pixelStorei(i.UNPACK_SKIP_IMAGES,0),h={},u={},Q=null,se={},d={},l={},f=new WeakMap,g=[],v=null,p=!1,m=null,y=null,R=null,b=null,A=null,E=null,_=null,T=new xt(0,0,0),O=0,I=!1,L=null,H=null,V=null,N=null,X=null,ee.set(0,0,i.canvas.width,i.canvas.height),me.set(0,0,i.canvas.width,i.canvas.height),r.reset(),o.reset(),a.reset()}return{buffers:{color:r,depth:o,stencil:a},enable:Se,disable:Ge,bindFramebuffer:st,drawBuffers:He,useProgram:ft,setBlending:Jt,setMaterial:Gt,setFlipSided:un,setCullFace:Ut,setLineWidth:En,setPolygonOffset:wt,setScissorTest:xn,activeTexture:tn,bindTexture:dn,unbindTexture:U,compressedTexImage2D:Ce,compressedTexImage3D:Ye,texImage2D:S,texImage3D:q,pixelStorei:oe,getParameter:he,updateUBOMapping:te,uniformBlockBinding:ie,texStorage2D:Xe,texStorage3D:C,texSubImage2D:rt,texSubImage3D:Me,compressedTexSubImage2D:kt,compressedTexSubImage3D:ze,scissor:ve,viewport:xe,reset:pe}}function qS(i,e,t,n,s,r,o){let a=e.has("WEBGL_multisampled_render_to_texture")?e.get("WEBGL_multisampled_render_to_texture"):null,l=typeof navigator>"u"?!1:/OculusBrowser/g.test(navigator.userAgent),c=new vt,h=new WeakMap,u=new Set,d,f=new WeakMap,g=new Set,v=new FinalizationRegistry(C=>g.delete(C)),p=!1;try{p=typeof OffscreenCanvas<"u"&&new OffscreenCanvas(1,1).getContext("2d")!==null}catch{}function m(C,S){return p?new OffscreenCanvas(C,S):na("canvas")}function y(C,S,q){let he=1,oe=Xe(C);if((oe.width>q||oe.height>q)&&(he=q/Math.max(oe.width,oe.height)),he<1)if(typeof HTMLImageElement<"u"&&C instanceof HTMLImageElement||typeof HTMLCanvasElement<"u"&&C instanceof HTMLCanvasElement||typeof ImageBitmap<"u"&&C instanceof ImageBitmap||typeof VideoFrame<"u"&&C instanceof VideoFrame){let ve=Math.floor(he*oe.width),xe=Math.floor(he*oe.height);d===void 0&&(d=m(ve,xe));let te=S?m(ve,xe):d;return te.width=ve,te.height=xe,te.getContext("2d").drawImage(C,0,0,ve,xe),$e("WebGLRenderer: Texture has been resized from ("+oe.width+"x"+oe.height+") to ("+ve+"x"+xe+")."),te}else return"data"in C&&$e("WebGLRenderer: Image in DataTexture is too big ("+oe.width+"x"+oe.height+")."),C;return C}function R(C){return C.generateMipmaps}function b(C){i.generateMipmap(C)}function A(C){return C.isWebGLCubeRenderTarget?i.TEXTURE_CUBE_MAP:C.isWebGL3DRenderTarget?i.TEXTURE_3D:C.isWebGLArrayRenderTarget||C.isCompressedArrayTexture?i.TEXTURE_2D_ARRAY:i.TEXTURE_2D}function E(C,S,q,he,oe,ve=!1){if(C!==null){if(i[C]!==void 0)return i[C];$e("WebGLRenderer: Attempt to use non-existing WebGL internal format '"+C+"'")}let xe;he&&(xe=e.get("EXT_texture_norm16"),xe||$e("WebGLRenderer: Unable to use normalized textures without EXT_texture_norm16 extension"));let te=S;if(S===i.RED&&(q===i.FLOAT&&(te=i.R32F),q===i.HALF_FLOAT&&(te=i.R16F),q===i.UNSIGNED_BYTE&&(te=i.R8),q===i.UNSIGNED_SHORT&&xe&&(te=xe.R16_EXT),q===i.SHORT&&xe&&(te=xe.R16_SNORM_EXT)),S===i.RED_INTEGER&&(q===i.UNSIGNED_BYTE&&(te=i.R8UI),q===i.UNSIGNED_SHORT&&(te=i.R16UI),q===i.UNSIGNED_INT&&(te=i.R32UI),q===i.BYTE&&(te=i.R8I),q===i.SHORT&&(te=i.R16I),q===i.INT&&(te=i.R32I)),S===i.RG&&(q===i.FLOAT&&(te=i.RG32F),q===i.HALF_FLOAT&&(te=i.RG16F),q===i.UNSIGNED_BYTE&&(te=i.RG8),q===i.UNSIGNED_SHORT&&xe&&(te=xe.RG16_EXT),q===i.SHORT&&xe&&(te=xe.RG16_SNORM_EXT)),S===i.RG_INTEGER&&(q===i.UNSIGNED_BYTE&&(te=i.RG8UI),q===i.UNSIGNED_SHORT&&(te=i.RG16UI),q===i.UNSIGNED_INT&&(te=i.RG32UI),q===i.BYTE&&(te=i.RG8I),q===i.SHORT&&(te=i.RG16I),q===i.INT&&(te=i.RG32I)),S===i.RGB_INTEGER&&(q===i.UNSIGNED_BYTE&&(te=i.RGB8UI),q===i.UNSIGNED_SHORT&&(te=i.RGB16UI),q===i.UNSIGNED_INT&&(te=i.RGB32UI),q===i.BYTE&&(te=i.RGB8I),q===i.SHORT&&(te=i.RGB16I),q===i.INT&&(te=i.RGB32I)),S===i.RGBA_INTEGER&&(q===i.UNSIGNED_BYTE&&(te=i.RGBA8UI),q===i.UNSIGNED_SHORT&&(te=i.RGBA16UI),q===i.UNSIGNED_INT&&(te=i.RGBA32UI),q===i.BYTE&&(te=i.RGBA8I),q===i.SHORT&&(te=i.RGBA16I),q===i.INT&&(te=i.RGBA32I)),S===i.RGB&&(q===i.UNSIGNED_SHORT&&xe&&(te=xe.RGB16_EXT),q===i.SHORT&&xe&&(te=xe.RGB16_SNORM_EXT),q===i.UNSIGNED_INT_5_9_9_9_REV&&(te=i.RGB9_E5),q===i.UNSIGNED_INT_10F_11F_11F_REV&&(te=i.R11F_G11F_B10F)),S===i.RGBA){let ie=ve?ea:gt.getTransfer(oe);q===i.FLOAT&&(te=i.RGBA32F),q===i.HALF_FLOAT&&(te=i.RGBA16F),q===i.UNSIGNED_BYTE&&(te=ie===Pt?i.SRGB8_ALPHA8:i.RGBA8),q===i.UNSIGNED_SHORT&&xe&&(te=xe.RGBA16_EXT),q===i.SHORT&&xe&&(te=xe.RGBA16_SNORM_EXT),q===i.UNSIGNED_SHORT_4_4_4_4&&(te=i.RGBA4),q===i.UNSIGNED_SHORT_5_5_5_1&&(te=i.RGB5_A1)}return(te===i.R16F||te===i.R32F||te===i.RG16F||te===i.RG32F||te===i.RGBA16F||te===i.RGBA32F)&&e.get("EXT_color_buffer_float"),te}function _(C,S){let q;return C?S===null||S===xi||S===wr?q=i.DEPTH24_STENCIL8:S===ti?q=i.DEPTH32F_STENCIL8:S===xo&&(q=i.DEPTH24_STENCIL8,$e("DepthTexture: 16 bit depth attachment is not supported with stencil. Using 24-bit attachment.")):S===null||S===xi||S===wr?q=i.DEPTH_COMPONENT24:S===ti?q=i.DEPTH_COMPONENT32F:S===xo&&(q=i.DEPTH_COMPONENT16),q}function T(C,S){return R(C)===!0||C.isFramebufferTexture&&C.minFilter!==an&&C.minFilter!==Fn?Math.log2(Math.max(S.width,S.height))+1:C.mipmaps.length>0?C.mipmaps.length:C.isCompressedTexture&&Array.isArray(C.image)?S.mipmaps.length:1}function O(C){let S=new WeakRef(C);n.get(C).__ref=S,g.add(S),v.register(C,S,S)}function I(C){let S=n.get(C).__ref;S!==void 0&&(g.delete(S),v.unregister(S))}function L(C){V(C.target)}function H(C){N(C.target)}function V(C){C.removeEventListener("dispose",L),I(C),$(C),C.isVideoTexture&&h.delete(C),C.isHTMLTexture&&u.delete(C)}function N(C){C.removeEventListener("dispose",H),I(C),ce(C)}function X(){for(let C of g){let S=C.deref();S!==void 0&&(S.isRenderTarget===!0?N(S):V(S))}g.clear(),u.clear()}function $(C){let S=n.get(C);if(S.__webglInit===void 0)return;let q=C.source,he=f.get(q);if(he){let oe=he[S.__cacheKey];oe.usedTimes--,oe.usedTimes===0&&W(C),Object.keys(he).length===0&&f.delete(q)}n.remove(C)}function W(C){let S=n.get(C);i.deleteTexture(S.__webglTexture);let q=C.source,he=f.get(q);delete he[S.__cacheKey],o.memory.textures--}function ce(C){let S=n.get(C);S.__depthDisposeCallback&&S.__depthDisposeCallback();let q=C.depthTexture;if(q&&q.renderTarget===C&&V(q),C.isWebGLCubeRenderTarget)for(let oe=0;oe<6;oe++){if(Array.isArray(S.__webglFramebuffer[oe]))for(let ve=0;ve<S.__webglFramebuffer[oe].length;ve++)i.deleteFramebuffer(S.__webglFramebuffer[oe][ve]);else i.deleteFramebuffer(S.__webglFramebuffer[oe]);S.__webglDepthbuffer&&i.deleteRenderbuffer(S.__webglDepthbuffer[oe])}else{if(Array.isArray(S.__webglFramebuffer))for(let oe=0;oe<S.__webglFramebuffer.length;oe++)i.deleteFramebuffer(S.__webglFramebuffer[oe]);else i.deleteFramebuffer(S.__webglFramebuffer);if(S.__webglDepthbuffer&&i.deleteRenderbuffer(S.__webglDepthbuffer),S.__webglMultisampledFramebuffer&&i.deleteFramebuffer(S.__webglMultisampledFramebuffer),S.__webglColorRenderbuffer)for(let oe=0;oe<S.__webglColorRenderbuffer.length;oe++)S.__webglColorRenderbuffer[oe]&&i.deleteRenderbuffer(S.__webglColorRenderbuffer[oe]);S.__webglDepthRenderbuffer&&i.deleteRenderbuffer(S.__webglDepthRenderbuffer)}let he=C.textures;for(let oe=0,ve=he.length;oe<ve;oe++){let xe=n.get(he[oe]);xe.__webglTexture&&(i.deleteTexture(xe.__webglTexture),o.memory.textures--),n.remove(he[oe])}n.remove(C)}let J=0;function Q(){J=0}function se(){return J}function de(C){J=C}function ue(){let C=J;return C>=s.maxTextures&&$e("WebGLTextures: Trying to use "+(C+1)+" texture units while this GPU supports only "+s.maxTextures),J+=1,C}function ee(C){let S=[];return S.push(C.wrapS),S.push(C.wrapT),S.push(C.wrapR||0),S.push(C.magFilter),S.push(C.minFilter),S.push(C.anisotropy),S.push(C.internalFormat),S.push(C.format),S.push(C.type),S.push(C.generateMipmaps),S.push(C.mipmapsAutoUpdate),S.push(C.premultiplyAlpha),S.push(C.flipY),S.push(C.unpackAlignment),S.push(C.colorSpace),S.join()}function me(C,S){let q=n.get(C);if(C.isVideoTexture&&kt(C),C.isRenderTargetTexture===!1&&C.isExternalTexture!==!0&&C.version>0&&q.__version!==C.version){let he=C.image;if(he===null)$e("WebGLRenderer: Texture marked for update but no image data found.");else if(he.complete===!1)$e("WebGLRenderer: Texture marked for update but image is incomplete");else{Gt(q,C,S);return}}else C.isExternalTexture&&(q.__webglTexture=C.sourceTexture?C.sourceTexture:null);t.bindTexture(i.TEXTURE_2D,q.__webglTexture,i.TEXTURE0+S)}function _e(C,S){let q=n.get(C);if(C.isRenderTargetTexture===!1&&C.version>0&&q.__version!==C.version){Gt(q,C,S);return}else C.isExternalTexture&&(q.__webglTexture=C.sourceTexture?C.sourceTexture:null);t.bindTexture(i.TEXTURE_2D_ARRAY,q.__webglTexture,i.TEXTURE0+S)}function Ae(C,S){let q=n.get(C);if(C.isRenderTargetTexture===!1&&C.version>0&&q.__version!==C.version){Gt(q,C,S);return}t.bindTexture(i.TEXTURE_3D,q.__webglTexture,i.TEXTURE0+S)}function Se(C,S){let q=n.get(C);if(C.version>0&&q.__version!==C.version){un(q,C,S);return}t.bindTexture(i.TEXTURE_CUBE_MAP,q.__webglTexture,i.TEXTURE0+S)}let Ge={[Ks]:i.REPEAT,[ts]:i.CLAMP_TO_EDGE,[Dl]:i.MIRRORED_REPEAT},st={[an]:i.NEAREST,[Gp]:i.NEAREST_MIPMAP_NEAREST,[_a]:i.NEAREST_MIPMAP_LINEAR,[Fn]:i.LINEAR,[oc]:i.LINEAR_MIPMAP_NEAREST,[vi]:i.LINEAR_MIPMAP_LINEAR},He={[Yp]:i.NEVER,[Qu]:i.ALWAYS,[$p]:i.LESS,[Ju]:i.LEQUAL,[Zp]:i.EQUAL,[ju]:i.GEQUAL,[Kp]:i.GREATER,[Jp]:i.NOTEQUAL};function ft(C,S){if(S.type===ti&&e.has("OES_texture_float_linear")===!1&&(S.magFilter===Fn||S.magFilter===oc||S.magFilter===_a||S.magFilter===vi||S.minFilter===Fn||S.minFilter===oc||S.minFilter===_a||S.minFilter===vi)&&$e("WebGLRenderer: Unable to use linear filtering with floating point textures. OES_texture_float_linear not supported on this device."),i.texParameteri(C,i.TEXTURE_WRAP_S,Ge[S.wrapS]),i.texParameteri(C,i.TEXTURE_WRAP_T,Ge[S.wrapT]),(C===i.TEXTURE_3D||C===i.TEXTURE_2D_ARRAY)&&i.texParameteri(C,i.TEXTURE_WRAP_R,Ge[S.wrapR]),i.texParameteri(C,i.TEXTURE_MAG_FILTER,st[S.magFilter]),i.texParameteri(C,i.TEXTURE_MIN_FILTER,st[S.minFilter]),S.compareFunction&&(i.texParameteri(C,i.TEXTURE_COMPARE_MODE,i.COMPARE_REF_TO_TEXTURE),i.texParameteri(C,i.TEXTURE_COMPARE_FUNC,He[S.compareFunction])),e.has("EXT_texture_filter_anisotropic")===!0){if(S.magFilter===an||S.minFilter!==_a&&S.minFilter!==vi||S.type===ti&&e.has("OES_texture_float_linear")===!1)return;if(S.anisotropy>1||n.get(S).__currentAnisotropy){let q=e.get("EXT_texture_filter_anisotropic");i.texParameterf(C,q.TEXTURE_MAX_ANISOTROPY_EXT,Math.min(S.anisotropy,s.getMaxAnisotropy())),n.get(S).__currentAnisotropy=S.anisotropy}}}function ct(C,S){let q=!1;C.__webglInit===void 0&&(C.__webglInit=!0,S.addEventListener("dispose",L),O(S));let he=S.source,oe=f.get(he);oe===void 0&&(oe={},f.set(he,oe));let ve=ee(S);if(ve!==C.__cacheKey){oe[ve]===void 0&&(oe[ve]={texture:i.createTexture(),usedTimes:0},o.memory.textures++,q=!0),oe[ve].usedTimes++;let xe=oe[C.__cacheKey];xe!==void 0&&(oe[C.__cacheKey].usedTimes--,xe.usedTimes===0&&W(S)),C.__cacheKey=ve,C.__webglTexture=oe[ve].texture}return q}function tt(C,S,q){return Math.floor(Math.floor(C/q)/S)}function Jt(C,S,q,he){let ve=C.updateRanges;if(ve.length===0)t.texSubImage2D(i.TEXTURE_2D,0,0,0,S.width,S.height,q,he,S.data);else{ve.sort((F,re)=>F.start-re.start);let xe=0;for(let F=1;F<ve.length;F++){let re=ve[xe],ne=ve[F],we=re.start+re.count,ge=tt(ne.start,S.width,4),be=tt(re.start,S.width,4);ne.start<=we+1&&ge===be&&tt(ne.start+ne.count-1,S.width,4)===ge?re.count=Math.max(re.count,ne.start+ne.count-re.start):(++xe,ve[xe]=ne)}ve.length=xe+1;let te=t.getParameter(i.UNPACK_ROW_LENGTH),ie=t.getParameter(i.UNPACK_SKIP_PIXELS),pe=t.getParameter(i.UNPACK_SKIP_ROWS);t.pixelStorei(i.UNPACK_ROW_LENGTH,S.width);for(let F=0,re=ve.length;F<re;F++){let ne=ve[F],we=Math.floor(ne.start/4),ge=Math.ceil(ne.count/4),be=we%S.width,Ve=Math.floor(we/S.width),Ke=ge,le=1;t.pixelStorei(i.UNPACK_SKIP_PIXELS,be),t.pixelStorei(i.UNPACK_SKIP_ROWS,Ve),t.texSubImage2D(i.TEXTURE_2D,0,be,Ve,Ke,le,q,he,S.data)}C.clearUpdateRanges(),t.pixelStorei(i.UNPACK_ROW_LENGTH,te),t.pixelStorei(i.UNPACK_SKIP_PIXELS,ie),t.pixelStorei(i.UNPACK_SKIP_ROWS,pe)}}function Gt(C,S,q){let he=i.TEXTURE_2D;(S.isDataArrayTexture||S.isCompressedArrayTexture)&&(he=i.TEXTURE_2D_ARRAY),S.isData3DTexture&&(he=i.TEXTURE_3D);let oe=ct(C,S),ve=S.source;t.bindTexture(he,C.__webglTexture,i.TEXTURE0+q);let xe=n.get(ve);if(ve.version!==xe.__version||oe===!0){if(t.activeTexture(i.TEXTURE0+q),(typeof ImageBitmap<"u"&&S.image instanceof ImageBitmap)===!1){let le=gt.getPrimaries(gt.workingColorSpace),Oe=S.colorSpace===Rs?null:gt.getPrimaries(S.colorSpace),Je=S.colorSpace===Rs||le===Oe?i.NONE:i.BROWSER_DEFAULT_WEBGL;t.pixelStorei(i.UNPACK_FLIP_Y_WEBGL,S.flipY),t.pixelStorei(i.UNPACK_PREMULTIPLY_ALPHA_WEBGL,S.premultiplyAlpha),t.pixelStorei(i.UNPACK_COLORSPACE_CONVERSION_WEBGL,Je)}t.pixelStorei(i.UNPACK_ALIGNMENT,S.unpackAlignment);let ie=y(S.image,!1,s.maxTextureSize);ie=ze(S,ie);let pe=r.convert(S.format,S.colorSpace),F=r.convert(S.type),re=E(S.internalFormat,pe,F,S.normalized,S.colorSpace,S.isVideoTexture);ft(he,S);let ne,we=S.mipmaps,ge=S.isVideoTexture!==!0,be=xe.__version===void 0||oe===!0,Ve=ve.dataReady,Ke=T(S,ie);if(S.isDepthTexture)re=_(S.format===As,S.type),be&&(ge?t.texStorage2D(i.TEXTURE_2D,1,re,ie.width,ie.height):t.texImage2D(i.TEXTURE_2D,0,re,ie.width,ie.height,0,pe,F,null));else if(S.isDataTexture)if(we.length>0){ge&&be&&t.texStorage2D(i.TEXTURE_2D,Ke,re,we[0].width,we[0].height);for(let le=0,Oe=we.length;le<Oe;le++)ne=we[le],ge?Ve&&t.texSubImage2D(i.TEXTURE_2D,le,0,0,ne.width,ne.height,pe,F,ne.data):t.texImage2D(i.TEXTURE_2D,le,re,ne.width,ne.height,0,pe,F,ne.data);S.generateMipmaps=!1}else ge?(be&&t.texStorage2D(i.TEXTURE_2D,Ke,re,ie.width,ie.height),Ve&&Jt(S,ie,pe,F)):t.texImage2D(i.TEXTURE_2D,0,re,ie.width,ie.height,0,pe,F,ie.data);else if(S.isCompressedTexture)if(S.isCompressedArrayTexture){ge&&be&&t.texStorage3D(i.TEXTURE_2D_ARRAY,Ke,re,we[0].width,we[0].height,ie.depth);for(let le=0,Oe=we.length;le<Oe;le++)if(ne=we[le],S.format!==yi)if(pe!==null)if(ge){if(Ve)if(S.layerUpdates.size>0){let Je=od(ne.width,ne.height,S.format,S.type);for(let Re of S.layerUpdates){let ot=ne.data.subarray(Re*Je/ne.data.BYTES_PER_ELEMENT,(Re+1)*Je/ne.data.BYTES_PER_ELEMENT);t.compressedTexSubImage3D(i.TEXTURE_2D_ARRAY,le,0,0,Re,ne.width,ne.height,1,pe,ot)}}else t.compressedTexSubImage3D(i.TEXTURE_2D_ARRAY,le,0,0,0,ne.width,ne.height,ie.depth,pe,ne.data)}else t.compressedTexImage3D(i.TEXTURE_2D_ARRAY,le,re,ne.width,ne.height,ie.depth,0,ne.data,0,0);else $e("WebGLRenderer: Attempt to load unsupported compressed texture format in .uploadTexture()");else ge?Ve&&t.texSubImage3D(i.TEXTURE_2D_ARRAY,le,0,0,0,ne.width,ne.height,ie.depth,pe,F,ne.data):t.texImage3D(i.TEXTURE_2D_ARRAY,le,re,ne.width,ne.height,ie.depth,0,pe,F,ne.data);S.layerUpdates.size>0&&S.clearLayerUpdates()}else{ge&&be&&t.texStorage2D(i.TEXTURE_2D,Ke,re,we[0].width,we[0].height);for(let le=0,Oe=we.length;le<Oe;le++)ne=we[le],S.format!==yi?pe!==null?ge?Ve&&t.compressedTexSubImage2D(i.TEXTURE_2D,le,0,0,ne.width,ne.height,pe,ne.data):t.compressedTexImage2D(i.TEXTURE_2D,le,re,ne.width,ne.height,0,ne.data):$e("WebGLRenderer: Attempt to load unsupported compressed texture format in .uploadTexture()"):ge?Ve&&t.texSubImage2D(i.TEXTURE_2D,le,0,0,ne.width,ne.height,pe,F,ne.data):t.texImage2D(i.TEXTURE_2D,le,re,ne.width,ne.height,0,pe,F,ne.data)}else if(S.isDataArrayTexture)if(ge){if(be&&t.texStorage3D(i.TEXTURE_2D_ARRAY,Ke,re,ie.width,ie.height,ie.depth),Ve)if(S.layerUpdates.size>0){let le=od(ie.width,ie.height,S.format,S.type);for(let Oe of S.layerUpdates){let Je=ie.data.subarray(Oe*le/ie.data.BYTES_PER_ELEMENT,(Oe+1)*le/ie.data.BYTES_PER_ELEMENT);t.texSubImage3D(i.TEXTURE_2D_ARRAY,0,0,0,Oe,ie.width,ie.height,1,pe,F,Je)}S.clearLayerUpdates()}else t.texSubImage3D(i.TEXTURE_2D_ARRAY,0,0,0,0,ie.width,ie.height,ie.depth,pe,F,ie.data)}else t.texImage3D(i.TEXTURE_2D_ARRAY,0,re,ie.width,ie.height,ie.depth,0,pe,F,ie.data);else if(S.isData3DTexture)ge?(be&&t.texStorage3D(i.TEXTURE_3D,Ke,re,ie.width,ie.height,ie.depth),Ve&&t.texSubImage3D(i.TEXTURE_3D,0,0,0,0,ie.width,ie.height,ie.depth,pe,F,ie.data)):t.texImage3D(i.TEXTURE_3D,0,re,ie.width,ie.height,ie.depth,0,pe,F,ie.data);else if(S.isFramebufferTexture){if(be)if(ge)t.texStorage2D(i.TEXTURE_2D,Ke,re,ie.width,ie.height);else{let le=ie.width,Oe=ie.height;for(let Je=0;Je<Ke;Je++)t.texImage2D(i.TEXTURE_2D,Je,re,le,Oe,0,pe,F,null),le>>=1,Oe>>=1}}else if(S.isHTMLTexture){if("texElementImage2D"in i){let le=i.canvas;if(le.hasAttribute("layoutsubtree")||le.setAttribute("layoutsubtree","true"),ie.parentNode!==le){le.appendChild(ie),u.add(S),le.onpaint=Oe=>{let Je=Oe.changedElements;for(let Re of u)Je.includes(Re.image)&&(Re.needsUpdate=!0)},le.requestPaint();return}if(i.texElementImage2D.length===3)i.texElementImage2D(i.TEXTURE_2D,i.RGBA8,ie);else{let Je=i.RGBA,Re=i.RGBA,ot=i.UNSIGNED_BYTE;i.texElementImage2D(i.TEXTURE_2D,0,Je,Re,ot,ie)}i.texParameteri(i.TEXTURE_2D,i.TEXTURE_MIN_FILTER,i.LINEAR),i.texParameteri(i.TEXTURE_2D,i.TEXTURE_WRAP_S,i.CLAMP_TO_EDGE),i.texParameteri(i.TEXTURE_2D,i.TEXTURE_WRAP_T,i.CLAMP_TO_EDGE)}}else if(we.length>0){if(ge&&be){let le=Xe(we[0]);t.texStorage2D(i.TEXTURE_2D,Ke,re,le.width,le.height)}for(let le=0,Oe=we.length;le<Oe;le++)ne=we[le],ge?Ve&&t.texSubImage2D(i.TEXTURE_2D,le,0,0,pe,F,ne):t.texImage2D(i.TEXTURE_2D,le,re,pe,F,ne);S.generateMipmaps=!1}else if(ge){if(be){let le=Xe(ie);t.texStorage2D(i.TEXTURE_2D,Ke,re,le.width,le.height)}Ve&&t.texSubImage2D(i.TEXTURE_2D,0,0,0,pe,F,ie)}else t.texImage2D(i.TEXTURE_2D,0,re,pe,F,ie);R(S)&&S.mipmapsAutoUpdate===!0&&b(he),xe.__version=ve.version,S.onUpdate&&S.onUpdate(S)}C.__version=S.version}function un(C,S,q){if(S.image.length!==6)return;let he=ct(C,S),oe=S.source;t.bindTexture(i.TEXTURE_CUBE_MAP,C.__webglTexture,i.TEXTURE0+q);let ve=n.get(oe);if(oe.version!==ve.__version||he===!0){t.activeTexture(i.TEXTURE0+q);let xe=gt.getPrimaries(gt.workingColorSpace),te=S.colorSpace===Rs?null:gt.getPrimaries(S.colorSpace),ie=S.colorSpace===Rs||xe===te?i.NONE:i.BROWSER_DEFAULT_WEBGL;t.pixelStorei(i.UNPACK_FLIP_Y_WEBGL,S.flipY),t.pixelStorei(i.UNPACK_PREMULTIPLY_ALPHA_WEBGL,S.premultiplyAlpha),t.pixelStorei(i.UNPACK_ALIGNMENT,S.unpackAlignment),t.pixelStorei(i.UNPACK_COLORSPACE_CONVERSION_WEBGL,ie);let pe=S.isCompressedTexture||S.image[0].isCompressedTexture,F=S.image[0]&&S.image[0].isDataTexture,re=[];for(let Re=0;Re<6;Re++)!pe&&!F?re[Re]=y(S.image[Re],!0,s.maxCubemapSize):re[Re]=F?S.image[Re].image:S.image[Re],re[Re]=ze(S,re[Re]);let ne=re[0],we=r.convert(S.format,S.colorSpace),ge=r.convert(S.type),be=E(S.internalFormat,we,ge,S.normalized,S.colorSpace),Ve=S.isVideoTexture!==!0,Ke=ve.__version===void 0||he===!0,le=oe.dataReady,Oe=T(S,ne);ft(i.TEXTURE_CUBE_MAP,S);let Je;if(S.isDepthTexture){if(be=_(S.format===As,S.type),Ke)if(Ve)t.texStorage2D(i.TEXTURE_CUBE_MAP,1,be,ne.width,ne.height);else for(let Re=0;Re<6;Re++)t.texImage2D(i.TEXTURE_CUBE_MAP_POSITIVE_X+Re,0,be,ne.width,ne.height,0,we,ge,null)}else if(pe){Ve&&Ke&&t.texStorage2D(i.TEXTURE_CUBE_MAP,Oe,be,ne.width,ne.height);for(let Re=0;Re<6;Re++){Je=re[Re].mipmaps;for(let ot=0;ot<Je.length;ot++){let Xt=Je[ot];S.format!==yi?we!==null?Ve?le&&t.compressedTexSubImage2D(i.TEXTURE_CUBE_MAP_POSITIVE_X+Re,ot,0,0,Xt.width,Xt.height,we,Xt.data):t.compressedTexImage2D(i.TEXTURE_CUBE_MAP_POSITIVE_X+Re,ot,be,Xt.width,Xt.height,0,Xt.data):$e("WebGLRenderer: Attempt to load unsupported compressed texture format in .setTextureCube()"):Ve?le&&t.texSubImage2D(i.TEXTURE_CUBE_MAP_POSITIVE_X+Re,ot,0,0,Xt.width,Xt.height,we,ge,Xt.data):t.texImage2D(i.TEXTURE_CUBE_MAP_POSITIVE_X+Re,ot,be,Xt.width,Xt.height,0,we,ge,Xt.data)}}}else{if(Je=S.mipmaps,Ve&&Ke){Je.length>0&&Oe++;let Re=Xe(re[0]);t.texStorage2D(i.TEXTURE_CUBE_MAP,Oe,be,Re.width,Re.height)}for(let Re=0;Re<6;Re++)if(F){Ve?le&&t.texSubImage2D(i.TEXTURE_CUBE_MAP_POSITIVE_X+Re,0,0,0,re[Re].width,re[Re].height,we,ge,re[Re].data):t.texImage2D(i.TEXTURE_CUBE_MAP_POSITIVE_X+Re,0,be,re[Re].width,re[Re].height,0,we,ge,re[Re].data);for(let ot=0;ot<Je.length;ot++){let Xn=Je[ot].image[Re].image;Ve?le&&t.texSubImage2D(i.TEXTURE_CUBE_MAP_POSITIVE_X+Re,ot+1,0,0,Xn.width,Xn.height,we,ge,Xn.data):t.texImage2D(i.TEXTURE_CUBE_MAP_POSITIVE_X+Re,ot+1,be,Xn.width,Xn.height,0,we,ge,Xn.data)}}else{Ve?le&&t.texSubImage2D(i.TEXTURE_CUBE_MAP_POSITIVE_X+Re,0,0,0,we,ge,re[Re]):t.texImage2D(i.TEXTURE_CUBE_MAP_POSITIVE_X+Re,0,be,we,ge,re[Re]);for(let ot=0;ot<Je.length;ot++){let Xt=Je[ot];Ve?le&&t.texSubImage2D(i.TEXTURE_CUBE_MAP_POSITIVE_X+Re,ot+1,0,0,we,ge,Xt.image[Re]):t.texImage2D(i.TEXTURE_CUBE_MAP_POSITIVE_X+Re,ot+1,be,we,ge,Xt.image[Re])}}}R(S)&&S.mipmapsAutoUpdate===!0&&b(i.TEXTURE_CUBE_MAP),ve.__version=oe.version,S.onUpdate&&S.onUpdate(S)}C.__version=S.version}function Ut(C,S,q,he,oe,ve){let xe=r.convert(q.format,q.colorSpace),te=r.convert(q.type),ie=E(q.internalFormat,xe,te,q.normalized,q.colorSpace),pe=n.get(S),F=n.get(q);if(F.__renderTarget=S,!pe.__hasExternalTextures){let re=Math.max(1,S.width>>ve),ne=Math.max(1,S.height>>ve);oe===i.TEXTURE_3D||oe===i.TEXTURE_2D_ARRAY?t.texImage3D(oe,ve,ie,re,ne,S.depth,0,xe,te,null):t.texImage2D(oe,ve,ie,re,ne,0,xe,te,null)}t.bindFramebuffer(i.FRAMEBUFFER,C),Me(S)?a.framebufferTexture2DMultisampleEXT(i.FRAMEBUFFER,he,oe,F.__webglTexture,0,rt(S)):(oe===i.TEXTURE_2D||oe>=i.TEXTURE_CUBE_MAP_POSITIVE_X&&oe<=i.TEXTURE_CUBE_MAP_NEGATIVE_Z)&&i.framebufferTexture2D(i.FRAMEBUFFER,he,oe,F.__webglTexture,ve),t.bindFramebuffer(i.FRAMEBUFFER,null)}function En(C,S,q){if(i.bindRenderbuffer(i.RENDERBUFFER,C),S.depthBuffer){let he=S.depthTexture,oe=he&&he.isDepthTexture?he.type:null,ve=_(S.stencilBuffer,oe),xe=S.stencilBuffer?i.DEPTH_STENCIL_ATTACHMENT:i.DEPTH_ATTACHMENT;Me(S)?a.renderbufferStorageMultisampleEXT(i.RENDERBUFFER,rt(S),ve,S.width,S.height):q?i.renderbufferStorageMultisample(i.RENDERBUFFER,rt(S),ve,S.width,S.height):i.renderbufferStorage(i.RENDERBUFFER,ve,S.width,S.height),i.framebufferRenderbuffer(i.FRAMEBUFFER,xe,i.RENDERBUFFER,C)}else{let he=S.textures;for(let oe=0;oe<he.length;oe++){let ve=he[oe],xe=r.convert(ve.format,ve.colorSpace),te=r.convert(ve.type),ie=E(ve.internalFormat,xe,te,ve.normalized,ve.colorSpace);Me(S)?a.renderbufferStorageMultisampleEXT(i.RENDERBUFFER,rt(S),ie,S.width,S.height):q?i.renderbufferStorageMultisample(i.RENDERBUFFER,rt(S),ie,S.width,S.height):i.renderbufferStorage(i.RENDERBUFFER,ie,S.width,S.height)}}i.bindRenderbuffer(i.RENDERBUFFER,null)}function wt(C,S,q){let he=S.isWebGLCubeRenderTarget===!0;if(t.bindFramebuffer(i.FRAMEBUFFER,C),!(S.depthTexture&&S.depthTexture.isDepthTexture))throw new Error("THREE.WebGLTextures: renderTarget.depthTexture must be an instance of THREE.DepthTexture.");let oe=n.get(S.depthTexture);oe.__renderTarget=S;let ve=he?S.depthTexture.image[0]:S.depthTexture.image;(!oe.__webglTexture||ve.width!==S.width||ve.height!==S.height)&&(ve.width=S.width,ve.height=S.height,S.depthTexture.needsUpdate=!0),he?Se(S.depthTexture,0):me(S.depthTexture,0);let xe=oe.__webglTexture,te=rt(S),ie=he?i.TEXTURE_CUBE_MAP_POSITIVE_X+q:i.TEXTURE_2D,pe=S.depthTexture.format===As?i.DEPTH_STENCIL_ATTACHMENT:i.DEPTH_ATTACHMENT;if(S.depthTexture.format===Ss)Me(S)?a.framebufferTexture2DMultisampleEXT(i.FRAMEBUFFER,pe,ie,xe,0,te):i.framebufferTexture2D(i.FRAMEBUFFER,pe,ie,xe,0);else if(S.depthTexture.format===As)Me(S)?a.framebufferTexture2DMultisampleEXT(i.FRAMEBUFFER,pe,ie,xe,0,te):i.framebufferTexture2D(i.FRAMEBUFFER,pe,ie,xe,0);else throw new Error("THREE.WebGLTextures: Unknown depthTexture format.")}function xn(C){let S=n.get(C),q=C.isWebGLCubeRenderTarget===!0;if(S.__boundDepthTexture!==C.depthTexture){let he=C.depthTexture;if(S.__depthDisposeCallback&&S.__depthDisposeCallback(),he){let oe=()=>{delete S.__boundDepthTexture,delete S.__depthDisposeCallback,he.removeEventListener("dispose",oe)};he.addEventListener("dispose",oe),S.__depthDisposeCallback=oe}S.__boundDepthTexture=he}if(C.depthTexture&&!S.__autoAllocateDepthBuffer)if(q)for(let he=0;he<6;he++)wt(S.__webglFramebuffer[he],C,he);else C.texture.mipmaps.length>0?wt(S.__webglFramebuffer[0],C,0):wt(S.__webglFramebuffer,C,0);else if(q){S.__webglDepthbuffer=[];for(let he=0;he<6;he++)if(t.bindFramebuffer(i.FRAMEBUFFER,S.__webglFramebuffer[he]),S.__webglDepthbuffer[he]===void 0)S.__webglDepthbuffer[he]=i.createRenderbuffer(),En(S.__webglDepthbuffer[he],C,!1);else{let oe=C.stencilBuffer?i.DEPTH_STENCIL_ATTACHMENT:i.DEPTH_ATTACHMENT,ve=S.__webglDepthbuffer[he];i.bindRenderbuffer(i.RENDERBUFFER,ve),i.framebufferRenderbuffer(i.FRAMEBUFFER,oe,i.RENDERBUFFER,ve)}}else if(C.texture.mipmaps.length>0?t.bindFramebuffer(i.FRAMEBUFFER,S.__webglFramebuffer[0]):t.bindFramebuffer(i.FRAMEBUFFER,S.__webglFramebuffer),S.__webglDepthbuffer===void 0)S.__webglDepthbuffer=i.createRenderbuffer(),En(S.__webglDepthbuffer,C,!1);else{let oe=C.stencilBuffer?i.DEPTH_STENCIL_ATTACHMENT:i.DEPTH_ATTACHMENT,ve=S.__webglDepthbuffer;i.bindRenderbuffer(i.RENDERBUFFER,ve),i.framebufferRenderbuffer(i.FRAMEBUFFER,oe,i.RENDERBUFFER,ve)}t.bindFramebuffer(i.FRAMEBUFFER,null)}function tn(C,S,q){let he=n.get(C);S!==void 0&&Ut(he.__webglFramebuffer,C,C.texture,i.COLOR_ATTACHMENT0,i.TEXTURE_2D,0),q!==void 0&&xn(C)}function dn(C){let S=C.texture,q=n.get(C),he=n.get(S);C.addEventListener("dispose",H),O(C);let oe=C.textures,ve=C.isWebGLCubeRenderTarget===!0,xe=oe.length>1;if(xe||(he.__webglTexture===void 0&&(he.__webglTexture=i.createTexture()),he.__version=S.version,o.memory.textures++),ve){q.__webglFramebuffer=[];for(let te=0;te<6;te++)if(S.mipmaps.length>0){q.__webglFramebuffer[te]=[];for(let ie=0;ie<S.mipmaps.length;ie++)q.__webglFramebuffer[te][ie]=i.createFramebuffer()}else q.__webglFramebuffer[te]=i.createFramebuffer()}else{if(S.mipmaps.length>0){q.__webglFramebuffer=[];for(let te=0;te<S.mipmaps.length;te++)q.__webglFramebuffer[te]=i.createFramebuffer()}else q.__webglFramebuffer=i.createFramebuffer();if(xe)for(let te=0,ie=oe.length;te<ie;te++){let pe=n.get(oe[te]);pe.__webglTexture===void 0&&(pe.__webglTexture=i.createTexture(),o.memory.textures++)}if(C.samples>0&&Me(C)===!1){q.__webglMultisampledFramebuffer=i.createFramebuffer(),q.__webglColorRenderbuffer=[],t.bindFramebuffer(i.FRAMEBUFFER,q.__webglMultisampledFramebuffer);for(let te=0;te<oe.length;te++){let ie=oe[te];q.__webglColorRenderbuffer[te]=i.createRenderbuffer(),i.bindRenderbuffer(i.RENDERBUFFER,q.__webglColorRenderbuffer[te]);let pe=r.convert(ie.format,ie.colorSpace),F=r.convert(ie.type),re=E(ie.internalFormat,pe,F,ie.normalized,ie.colorSpace,C.isXRRenderTarget===!0),ne=rt(C);i.renderbufferStorageMultisample(i.RENDERBUFFER,ne,re,C.width,C.height),i.framebufferRenderbuffer(i.FRAMEBUFFER,i.COLOR_ATTACHMENT0+te,i.RENDERBUFFER,q.__webglColorRenderbuffer[te])}i.bindRenderbuffer(i.RENDERBUFFER,null),C.depthBuffer&&(q.__webglDepthRenderbuffer=i.createRenderbuffer(),En(q.__webglDepthRenderbuffer,C,!0)),t.bindFramebuffer(i.FRAMEBUFFER,null)}}if(ve){t.bindTexture(i.TEXTURE_CUBE_MAP,he.__webglTexture),ft(i.TEXTURE_CUBE_MAP,S);for(let te=0;te<6;te++)if(S.mipmaps.length>0)for(let ie=0;ie<S.mipmaps.length;ie++)Ut(q.__webglFramebuffer[te][ie],C,S,i.COLOR_ATTACHMENT0,i.TEXTURE_CUBE_MAP_POSITIVE_X+te,ie);else Ut(q.__webglFramebuffer[te],C,S,i.COLOR_ATTACHMENT0,i.TEXTURE_CUBE_MAP_POSITIVE_X+te,0);R(S)?b(i.TEXTURE_CUBE_MAP):S.mipmaps.length>0&&i.texParameteri(i.TEXTURE_CUBE_MAP,i.TEXTURE_MAX_LEVEL,S.mipmaps.length-1),t.unbindTexture()}else if(xe){for(let te=0,ie=oe.length;te<ie;te++){let pe=oe[te],F=n.get(pe),re=i.TEXTURE_2D;(C.isWebGL3DRenderTarget||C.isWebGLArrayRenderTarget)&&(re=C.isWebGL3DRenderTarget?i.TEXTURE_3D:i.TEXTURE_2D_ARRAY),t.bindTexture(re,F.__webglTexture),ft(re,pe),Ut(q.__webglFramebuffer,C,pe,i.COLOR_ATTACHMENT0+te,re,0),R(pe)&&b(re)}t.unbindTexture()}else{let te=i.TEXTURE_2D;if((C.isWebGL3DRenderTarget||C.isWebGLArrayRenderTarget)&&(te=C.isWebGL3DRenderTarget?i.TEXTURE_3D:i.TEXTURE_2D_ARRAY),t.bindTexture(te,he.__webglTexture),ft(te,S),S.mipmaps.length>0)for(let ie=0;ie<S.mipmaps.length;ie++)Ut(q.__webglFramebuffer[ie],C,S,i.COLOR_ATTACHMENT0,te,ie);else Ut(q.__webglFramebuffer,C,S,i.COLOR_ATTACHMENT0,te,0);R(S)?b(te):S.mipmaps.length>0&&i.texParameteri(te,i.TEXTURE_MAX_LEVEL,S.mipmaps.length-1),t.unbindTexture()}C.depthBuffer&&xn(C)}function U(C){let S=C.textures;for(let q=0,he=S.length;q<he;q++){let oe=S[q];if(R(oe)&&oe.mipmapsAutoUpdate===!0){let ve=A(C),xe=n.get(oe).__webglTexture;t.bindTexture(ve,xe),b(ve),t.unbindTexture()}}}let Ce=[];function Ye(C){if(C.samples>0){if(Me(C)===!1){let S=C.textures,q=C.width,he=C.height,oe=i.COLOR_BUFFER_BIT,ve=C.stencilBuffer?i.DEPTH_STENCIL_ATTACHMENT:i.DEPTH_ATTACHMENT,xe=n.get(C),te=S.length>1;if(te)for(let pe=0;pe<S.length;pe++)t.bindFramebuffer(i.FRAMEBUFFER,xe.__webglMultisampledFramebuffer),i.framebufferRenderbuffer(i.FRAMEBUFFER,i.COLOR_ATTACHMENT0+pe,i.RENDERBUFFER,null),t.bindFramebuffer(i.FRAMEBUFFER,xe.__webglFramebuffer),i.framebufferTexture2D(i.DRAW_FRAMEBUFFER,i.COLOR_ATTACHMENT0+pe,i.TEXTURE_2D,null,0);t.bindFramebuffer(i.READ_FRAMEBUFFER,xe.__webglMultisampledFramebuffer),C.texture.mipmaps.length>0?t.bindFramebuffer(i.DRAW_FRAMEBUFFER,xe.__webglFramebuffer[0]):t.bindFramebuffer(i.DRAW_FRAMEBUFFER,xe.__webglFramebuffer);for(let pe=0;pe<S.length;pe++){if(C.resolveDepthBuffer&&(C.depthBuffer&&(oe|=i.DEPTH_BUFFER_BIT),C.stencilBuffer&&C.resolveStencilBuffer&&(oe|=i.STENCIL_BUFFER_BIT)),te){i.framebufferRenderbuffer(i.READ_FRAMEBUFFER,i.COLOR_ATTACHMENT0,i.RENDERBUFFER,xe.__webglColorRenderbuffer[pe]);let F=n.get(S[pe]).__webglTexture;i.framebufferTexture2D(i.DRAW_FRAMEBUFFER,i.COLOR_ATTACHMENT0,i.TEXTURE_2D,F,0)}i.blitFramebuffer(0,0,q,he,0,0,q,he,oe,i.NEAREST),l===!0&&(Ce.length=0,Ce.push(i.COLOR_ATTACHMENT0+pe),C.depthBuffer&&C.storeMultisampledDepthBuffer===!1&&Ce.push(ve),i.invalidateFramebuffer(i.READ_FRAMEBUFFER,Ce))}if(t.bindFramebuffer(i.READ_FRAMEBUFFER,null),t.bindFramebuffer(i.DRAW_FRAMEBUFFER,null),te)for(let pe=0;pe<S.length;pe++){t.bindFramebuffer(i.FRAMEBUFFER,xe.__webglMultisampledFramebuffer),i.framebufferRenderbuffer(i.FRAMEBUFFER,i.COLOR_ATTACHMENT0+pe,i.RENDERBUFFER,xe.__webglColorRenderbuffer[pe]);let F=n.get(S[pe]).__webglTexture;t.bindFramebuffer(i.FRAMEBUFFER,xe.__webglFramebuffer),i.framebufferTexture2D(i.DRAW_FRAMEBUFFER,i.COLOR_ATTACHMENT0+pe,i.TEXTURE_2D,F,0)}t.bindFramebuffer(i.DRAW_FRAMEBUFFER,xe.__webglMultisampledFramebuffer)}else if(C.depthBuffer&&C.storeMultisampledDepthBuffer===!1&&l){let S=C.stencilBuffer?i.DEPTH_STENCIL_ATTACHMENT:i.DEPTH_ATTACHMENT;i.invalidateFramebuffer(i.DRAW_FRAMEBUFFER,[S])}}}function rt(C){return Math.min(s.maxSamples,C.samples)}function Me(C){let S=n.get(C);return C.samples>0&&e.has("WEBGL_multisampled_render_to_texture")===!0&&S.__useRenderToTexture!==!1}function kt(C){let S=o.render.frame;h.get(C)!==S&&(h.set(C,S),C.update())}function ze(C,S){let q=C.colorSpace,he=C.format,oe=C.type;return C.isCompressedTexture===!0||C.isVideoTexture===!0||q!==mr&&q!==Rs&&(gt.getTransfer(q)===Pt?(he!==yi||oe!==_i)&&$e("WebGLTextures: sRGB encoded textures have to use RGBAFormat and UnsignedByteType."):Qe("WebGLTextures: Unsupported texture color space:",q)),S}function Xe(C){return typeof HTMLImageElement<"u"&&C instanceof HTMLImageElement?(c.width=C.naturalWidth||C.width,c.height=C.naturalHeight||C.height):typeof VideoFrame<"u"&&C instanceof VideoFrame?(c.width=C.displayWidth,c.height=C.displayHeight):(c.width=C.width,c.height=C.height),c}this.allocateTextureUnit=ue,this.resetTextureUnits=Q,this.getTextureUnits=se,this.setTextureUnits=de,this.setTexture2D=me,this.setTexture2DArray=_e,this.setTexture3D=Ae,this.setTextureCube=Se,this.rebindTextures=tn,this.setupRenderTarget=dn,this.updateRenderTargetMipmap=U,this.updateMultisampleRenderTarget=Ye,this.setupDepthRenderbuffer=xn,this.setupFrameBufferTexture=Ut,this.useMultisampledRTT=Me,this.dispose=X}function YS(i,e){function t(n,s=Rs){let r,o=gt.getTransfer(s);if(n===_i)return i.UNSIGNED_BYTE;if(n===lc)return i.UNSIGNED_SHORT_4_4_4_4;if(n===cc)return i.UNSIGNED_SHORT_5_5_5_1;if(n===qu)return i.UNSIGNED_INT_5_9_9_9_REV;if(n===Yu)return i.UNSIGNED_INT_10F_11F_11F_REV;if(n===Xu)return i.BYTE;if(n===xa)return i.SHORT;if(n===xo)return i.UNSIGNED_SHORT;if(n===ac)return i.INT;if(n===xi)return i.UNSIGNED_INT;if(n===ti)return i.FLOAT;if(n===Vi)return i.HALF_FLOAT;if(n===$u)return i.ALPHA;if(n===Zu)return i.RGB;if(n===yi)return i.RGBA;if(n===Ss)return i.DEPTH_COMPONENT;if(n===As)return i.DEPTH_STENCIL;if(n===hc)return i.RED;if(n===uc)return i.RED_INTEGER;if(n===sr)return i.RG;if(n===dc)return i.RG_INTEGER;if(n===yo)return i.RGBA_INTEGER;if(n===ya||n===ba||n===Sa||n===Ma)if(o===Pt)if(r=e.get("WEBGL_compressed_texture_s3tc_srgb"),r!==null){if(n===ya)return r.COMPRESSED_SRGB_S3TC_DXT1_EXT;if(n===ba)return r.COMPRESSED_SRGB_ALPHA_S3TC_DXT1_EXT;if(n===Sa)return r.COMPRESSED_SRGB_ALPHA_S3TC_DXT3_EXT;if(n===Ma)return r.COMPRESSED_SRGB_ALPHA_S3TC_DXT5_EXT}else return null;else if(r=e.get("WEBGL_compressed_texture_s3tc"),r!==null){if(n===ya)return r.COMPRESSED_RGB_S3TC_DXT1_EXT;if(n===ba)return r.COMPRESSED_RGBA_S3TC_DXT1_EXT;if(n===Sa)return r.COMPRESSED_RGBA_S3TC_DXT3_EXT;if(n===Ma)return r.COMPRESSED_RGBA_S3TC_DXT5_EXT}else return null;if(n===fc||n===pc||n===mc||n===gc)if(r=e.get("WEBGL_compressed_texture_pvrtc"),r!==null){if(n===fc)return r.COMPRESSED_RGB_PVRTC_4BPPV1_IMG;if(n===pc)return r.COMPRESSED_RGB_PVRTC_2BPPV1_IMG;if(n===mc)return r.COMPRESSED_RGBA_PVRTC_4BPPV1_IMG;if(n===gc)return r.COMPRESSED_RGBA_PVRTC_2BPPV1_IMG}else return null;if(n===vc||n===_c||n===xc||n===yc||n===bc||n===wa||n===Sc)if(r=e.get("WEBGL_compressed_texture_etc"),r!==null){if(n===vc||n===_c)return o===Pt?r.COMPRESSED_SRGB8_ETC2:r.COMPRESSED_RGB8_ETC2;if(n===xc)return o===Pt?r.COMPRESSED_SRGB8_ALPHA8_ETC2_EAC:r.COMPRESSED_RGBA8_ETC2_EAC;if(n===yc)return r.COMPRESSED_R11_EAC;if(n===bc)return r.COMPRESSED_SIGNED_R11_EAC;if(n===wa)return r.COMPRESSED_RG11_EAC;if(n===Sc)return r.COMPRESSED_SIGNED_RG11_EAC}else return null;if(n===Mc||n===wc||n===Ec||n===Tc||n===Ac||n===Rc||n===Cc||n===Pc||n===Ic||n===Lc||n===Dc||n===Nc||n===Fc||n===Uc)if(r=e.get("WEBGL_compressed_texture_astc"),r!==null){if(n===Mc)return o===Pt?r.COMPRESSED_SRGB8_ALPHA8_ASTC_4x4_KHR:r.COMPRESSED_RGBA_ASTC_4x4_KHR;if(n===wc)return o===Pt?r.COMPRESSED_SRGB8_ALPHA8_ASTC_5x4_KHR:r.COMPRESSED_RGBA_ASTC_5x4_KHR;if(n===Ec)return o===Pt?r.COMPRESSED_SRGB8_ALPHA8_ASTC_5x5_KHR:r.COMPRESSED_RGBA_ASTC_5x5_KHR;if(n===Tc)return o===Pt?r.COMPRESSED_SRGB8_ALPHA8_ASTC_6x5_KHR:r.COMPRESSED_RGBA_ASTC_6x5_KHR;if(n===Ac)return o===Pt?r.COMPRESSED_SRGB8_ALPHA8_ASTC_6x6_KHR:r.COMPRESSED_RGBA_ASTC_6x6_KHR;if(n===Rc)return o===Pt?r.COMPRESSED_SRGB8_ALPHA8_ASTC_8x5_KHR:r.COMPRESSED_RGBA_ASTC_8x5_KHR;if(n===Cc)return o===Pt?r.COMPRESSED_SRGB8_ALPHA8_ASTC_8x6_KHR:r.COMPRESSED_RGBA_ASTC_8x6_KHR;if(n===Pc)return o===Pt?r.COMPRESSED_SRGB8_ALPHA8_ASTC_8x8_KHR:r.COMPRESSED_RGBA_ASTC_8x8_KHR;if(n===Ic)return o===Pt?r.COMPRESSED_SRGB8_ALPHA8_ASTC_10x5_KHR:r.COMPRESSED_RGBA_ASTC_10x5_KHR;if(n===Lc)return o===Pt?r.COMPRESSED_SRGB8_ALPHA8_ASTC_10x6_KHR:r.COMPRESSED_RGBA_ASTC_10x6_KHR;if(n===Dc)return o===Pt?r.COMPRESSED_SRGB8_ALPHA8_ASTC_10x8_KHR:r.COMPRESSED_RGBA_ASTC_10x8_KHR;if(n===Nc)return o===Pt?r.COMPRESSED_SRGB8_ALPHA8_ASTC_10x10_KHR:r.COMPRESSED_RGBA_ASTC_10x10_KHR;if(n===Fc)return o===Pt?r.COMPRESSED_SRGB8_ALPHA8_ASTC_12x10_KHR:r.COMPRESSED_RGBA_ASTC_12x10_KHR;if(n===Uc)return o===Pt?r.COMPRESSED_SRGB8_ALPHA8_ASTC_12x12_KHR:r.COMPRESSED_RGBA_ASTC_12x12_KHR}else return null;if(n===Oc||n===Bc||n===kc)if(r=e.get("EXT_texture_compression_bptc"),r!==null){if(n===Oc)return o===Pt?r.COMPRESSED_SRGB_ALPHA_BPTC_UNORM_EXT:r.COMPRESSED_RGBA_BPTC_UNORM_EXT;if(n===Bc)return r.COMPRESSED_RGB_BPTC_SIGNED_FLOAT_EXT;if(n===kc)return r.COMPRESSED_RGB_BPTC_UNSIGNED_FLOAT_EXT}else return null;if(n===zc||n===Hc||n===Ea||n===Vc)if(r=e.get("EXT_texture_compression_rgtc"),r!==null){if(n===zc)return r.COMPRESSED_RED_RGTC1_EXT;if(n===Hc)return r.COMPRESSED_SIGNED_RED_RGTC1_EXT;if(n===Ea)return r.COMPRESSED_RED_GREEN_RGTC2_EXT;if(n===Vc)return r.COMPRESSED_SIGNED_RED_GREEN_RGTC2_EXT}else return null;return n===wr?i.UNSIGNED_INT_24_8:i[n]!==void 0?i[n]:null}return{convert:t}}var $S=`
void main() {

	gl_Position = vec4( position, 1.0 );

}`,ZS=`
uniform sampler2DArray depthColor;
uniform float depthWidth;
uniform float depthHeight;

void main() {

	vec2 coord = vec2( gl_FragCoord.x / depthWidth, gl_FragCoord.y / depthHeight );

	if ( coord.x >= 1.0 ) {

		gl_FragDepth = texture( depthColor, vec3( coord.x - 1.0, coord.y, 1 ) ).r;

	} else {

		gl_FragDepth = texture( depthColor, vec3( coord.x, coord.y, 0 ) ).r;

	}

}`,md=class{constructor(){this.texture=null,this.mesh=null,this.depthNear=0,this.depthFar=0}init(e,t){if(this.texture===null){let n=new da(e.texture);(e.depthNear!==t.depthNear||e.depthFar!==t.depthFar)&&(this.depthNear=e.depthNear,this.depthFar=e.depthFar),this.texture=n}}getMesh(e){if(this.texture!==null&&this.mesh===null){let t=e.cameras[0].viewport,n=new Wt({vertexShader:$S,fragmentShader:ZS,uniforms:{depthColor:{value:this.texture},depthWidth:{value:t.z},depthHeight:{value:t.w}}});this.mesh=new Bt(new Qs(20,20),n)}return this.mesh}reset(){this.texture=null,this.mesh=null}getDepthTexture(){return this.texture}},gd=class extends ns{constructor(e,t){super();let n=this,s=null,r=1,o=null,a="local-floor",l=1,c=null,h=null,u=null,d=null,f=null,g=null,v=typeof XRWebGLBinding<"u",p=new md,m={},y=t.getContextAttributes(),R=null,b=null,A=[],E=[],_=new vt,T=null,O=null,I=new pi;I.viewport=new en;let L=new pi;L.viewport=new en;let H=[I,L],V=new ic,N=null,X=null;this.cameraAutoUpdate=!0,this.enabled=!1,this.isPresenting=!1,this.getController=function(ee){let me=A[ee];return me===void 0&&(me=new co,A[ee]=me),me.getTargetRaySpace()},this.getControllerGrip=function(ee){let me=A[ee];return me===void 0&&(me=new co,A[ee]=me),me.getGripSpace()},this.getHand=function(ee){let me=A[ee];return me===void 0&&(me=new co,A[ee]=me),me.getHandSpace()};function $(ee){let me=E.indexOf(ee.inputSource);if(me===-1)return;let _e=A[me];_e!==void 0&&(_e.update(ee.inputSource,ee.frame,c||o),_e.dispatchEvent({type:ee.type,data:ee.inputSource}))}function W(){s.removeEventListener("select",$),s.removeEventListener("selectstart",$),s.removeEventListener("selectend",$),s.removeEventListener("squeeze",$),s.removeEventListener("squeezestart",$),s.removeEventListener("squeezeend",$),s.removeEventListener("end",W),s.removeEventListener("inputsourceschange",ce);for(let ee=0;ee<A.length;ee++){let me=E[ee];me!==null&&(E[ee]=null,A[ee].disconnect(me))}N=null,X=null,p.reset();for(let ee in m)delete m[ee];if(e.setRenderTarget(R),f=null,d=null,u=null,s=null,b=null,ue.stop(),n.isPresenting=!1,e.setPixelRatio(T),e.setSize(_.width,_.height,!1),O!==null){let ee=O.camera;ee.fov=O.fov,ee.zoom=O.zoom,ee.updateProjectionMatrix(),O=null}n.dispatchEvent({type:"sessionend"})}this.setFramebufferScaleFactor=function(ee){r=ee,n.isPresenting===!0&&$e("WebXRManager: Cannot change framebuffer scale while presenting.")},this.setReferenceSpaceType=function(ee){a=ee,n.isPresenting===!0&&$e("WebXRManager: Cannot change reference space type while presenting.")},this.getReferenceSpace=function(){return c||o},this.setReferenceSpace=function(ee){c=ee},this.getBaseLayer=function(){return d!==null?d:f},this.getBinding=function(){return u===null&&v&&(u=new XRWebGLBinding(s,t)),u},this.getFrame=function(){return g},this.getSession=function(){return s},this.setSession=async function(ee){if(s=ee,s!==null){if(R=e.getRenderTarget(),s.addEventListener("select",$),s.addEventListener("selectstart",$),s.addEventListener("selectend",$),s.addEventListener("squeeze",$),s.addEventListener("squeezestart",$),s.addEventListener("squeezeend",$),s.addEventListener("end",W),s.addEventListener("inputsourceschange",ce),y.xrCompatible!==!0&&await t.makeXRCompatible(),T=e.getPixelRatio(),e.getSize(_),v&&"createProjectionLayer"in XRWebGLBinding.prototype){let _e=null,Ae=null,Se=null;y.depth&&(Se=y.stencil?t.DEPTH24_STENCIL8:t.DEPTH_COMPONENT24,_e=y.stencil?As:Ss,Ae=y.stencil?wr:xi);let Ge={colorFormat:t.RGBA8,depthFormat:Se,scaleFactor:r};u=this.getBinding(),d=u.createProjectionLayer(Ge),s.updateRenderState({layers:[d]}),e.setPixelRatio(1),e.setSize(d.textureWidth,d.textureHeight,!1),b=new Kn(d.textureWidth,d.textureHeight,{format:yi,type:_i,depthTexture:new Hi(d.textureWidth,d.textureHeight,Ae,void 0,void 0,void 0,void 0,void 0,void 0,_e),stencilBuffer:y.stencil,colorSpace:e.outputColorSpace,samples:y.antialias?4:0,resolveDepthBuffer:d.ignoreDepthValues===!1,resolveStencilBuffer:d.ignoreDepthValues===!1,storeMultisampledDepthBuffer:d.ignoreDepthValues===!1,storeMultisampledStencilBuffer:d.ignoreDepthValues===!1})}else{let _e={antialias:y.antialias,alpha:!0,depth:y.depth,stencil:y.stencil,framebufferScaleFactor:r};f=new XRWebGLLayer(s,t,_e),s.updateRenderState({baseLayer:f}),e.setPixelRatio(1),e.setSize(f.framebufferWidth,f.framebufferHeight,!1),b=new Kn(f.framebufferWidth,f.framebufferHeight,{format:yi,type:_i,colorSpace:e.outputColorSpace,stencilBuffer:y.stencil,resolveDepthBuffer:f.ignoreDepthValues===!1,resolveStencilBuffer:f.ignoreDepthValues===!1,storeMultisampledDepthBuffer:f.ignoreDepthValues===!1,storeMultisampledStencilBuffer:f.ignoreDepthValues===!1})}b.isXRRenderTarget=!0,this.setFoveation(l),c=null,o=await s.requestReferenceSpace(a),ue.setContext(s),ue.start(),n.isPresenting=!0,n.dispatchEvent({type:"sessionstart"})}},this.getEnvironmentBlendMode=function(){if(s!==null)return s.environmentBlendMode},this.getDepthTexture=function(){return p.getDepthTexture()};function ce(ee){for(let me=0;me<ee.removed.length;me++){let _e=ee.removed[me],Ae=E.indexOf(_e);Ae>=0&&(E[Ae]=null,A[Ae].disconnect(_e))}for(let me=0;me<ee.added.length;me++){let _e=ee.added[me],Ae=E.indexOf(_e);if(Ae===-1){for(let Ge=0;Ge<A.length;Ge++)if(Ge>=E.length){E.push(_e),Ae=Ge;break}else if(E[Ge]===null){E[Ge]=_e,Ae=Ge;break}if(Ae===-1)break}let Se=A[Ae];Se&&Se.connect(_e)}}function J(ee,me){me===null?ee.matrixWorld.copy(ee.matrix):ee.matrixWorld.multiplyMatrices(me.matrixWorld,ee.matrix),ee.matrixWorldInverse.copy(ee.matrixWorld).invert()}this.updateCamera=function(ee){if(s===null)return;let me=ee.near,_e=ee.far;p.texture!==null&&(p.depthNear>0&&(me=p.depthNear),p.depthFar>0&&(_e=p.depthFar)),V.near=L.near=I.near=me,V.far=L.far=I.far=_e,(N!==V.near||X!==V.far)&&(s.updateRenderState({depthNear:V.near,depthFar:V.far}),N=V.near,X=V.far),V.layers.mask=ee.layers.mask|6,I.layers.mask=V.layers.mask&-5,L.layers.mask=V.layers.mask&-3;let Ae=ee.parent,Se=V.cameras;J(V,Ae);for(let Ge=0;Ge<Se.length;Ge++)J(Se[Ge],Ae);V.projectionMatrix.copy(I.projectionMatrix),V.projectionMatrixInverse.copy(I.projectionMatrixInverse),O===null&&ee.isPerspectiveCamera&&(O={camera:ee,fov:ee.fov,zoom:ee.zoom}),Q(ee,V,Ae)};function Q(ee,me,_e){_e===null?ee.matrix.copy(me.matrixWorld):(ee.matrix.copy(_e.matrixWorld),ee.matrix.invert(),ee.matrix.multiply(me.matrixWorld)),ee.matrix.decompose(ee.position,ee.quaternion,ee.scale),ee.updateMatrixWorld(!0),ee.projectionMatrix.copy(me.projectionMatrix),ee.projectionMatrixInverse.copy(me.projectionMatrixInverse),ee.isPerspectiveCamera&&(ee.fov=Fl*2*Math.atan(1/ee.projectionMatrix.elements[5]),ee.zoom=1)}this.getCamera=function(){return V},this.getFoveation=function(){if(!(d===null&&f===null))return l},this.setFoveation=function(ee){l=ee,d!==null&&(d.fixedFoveation=ee),f!==null&&f.fixedFoveation!==void 0&&(f.fixedFoveation=ee)},this.hasDepthSensing=function(){return p.texture!==null},this.getDepthSensingMesh=function(){return p.getMesh(V)},this.getCameraTexture=function(ee){return m[ee]};let se=null;function de(ee,me){if(h=me.getViewerPose(c||o),g=me,h!==null){let _e=h.views;f!==null&&(e.setRenderTargetFramebuffer(b,f.framebuffer),e.setRenderTarget(b));let Ae=!1;_e.length!==V.cameras.length&&(V.cameras.length=0,Ae=!0);for(let He=0;He<_e.length;He++){let ft=_e[He],ct=null;if(f!==null)ct=f.getViewport(ft);else{let Jt=u.getViewSubImage(d,ft);ct=Jt.viewport,He===0&&(e.setRenderTargetTextures(b,Jt.colorTexture,Jt.depthStencilTexture),e.setRenderTarget(b))}let tt=H[He];tt===void 0&&(tt=new pi,tt.layers.enable(He),tt.viewport=new en,H[He]=tt),tt.matrix.fromArray(ft.transform.matrix),tt.matrix.decompose(tt.position,tt.quaternion,tt.scale),tt.projectionMatrix.fromArray(ft.projectionMatrix),tt.projectionMatrixInverse.copy(tt.projectionMatrix).invert(),tt.viewport.set(ct.x,ct.y,ct.width,ct.height),He===0&&(V.matrix.copy(tt.matrix),V.matrix.decompose(V.position,V.quaternion,V.scale)),Ae===!0&&V.cameras.push(tt)}let Se=s.enabledFeatures;if(Se&&Se.includes("depth-sensing")&&s.depthUsage=="gpu-optimized"&&v){u=n.getBinding();let He=u.getDepthInformation(_e[0]);He&&He.isValid&&He.texture&&p.init(He,s.renderState)}if(Se&&Se.includes("camera-access")&&v){e.state.unbindTexture(),u=n.getBinding();for(let He=0;He<_e.length;He++){let ft=_e[He].camera;if(ft){let ct=m[ft];ct||(ct=new da,m[ft]=ct);let tt=u.getCameraImage(ft);ct.sourceTexture=tt}}}}for(let _e=0;_e<A.length;_e++){let Ae=E[_e],Se=A[_e];Ae!==null&&Se!==void 0&&Se.update(Ae,me,c||o)}se&&se(ee,me),me.detectedPlanes&&n.dispatchEvent({type:"planesdetected",data:me}),g=null}let ue=new Cm;ue.setAnimationLoop(de),this.setAnimationLoop=function(ee){se=ee},this.dispose=function(){}}},KS=new it,km=new qe;km.set(-1,0,0,0,1,0,0,0,1);function JS(i,e){function t(p,m){p.matrixAutoUpdate===!0&&p.updateMatrix(),m.value.copy(p.matrix)}function n(p,m){m.color.getRGB(p.fogColor.value,id(i)),m.isFog?(p.fogNear.value=m.near,p.fogFar.value=m.far):m.isFogExp2&&(p.fogDensity.value=m.density)}function s(p,m,y,R,b){m.isNodeMaterial?m.uniformsNeedUpdate=!1:m.isMeshBasicMaterial?r(p,m):m.isMeshLambertMaterial?(r(p,m),m.envMap&&(p.envMapIntensity.value=m.envMapIntensity)):m.isMeshToonMaterial?(r(p,m),u(p,m)):m.isMeshPhongMaterial?(r(p,m),h(p,m),m.envMap&&(p.envMapIntensity.value=m.envMapIntensity)):m.isMeshStandardMaterial?(r(p,m),d(p,m),m.isMeshPhysicalMaterial&&f(p,m,b)):m.isMeshMatcapMaterial?(r(p,m),g(p,m)):m.isMeshDepthMaterial?r(p,m):m.isMeshDistanceMaterial?(r(p,m),v(p,m)):m.isMeshNormalMaterial?r(p,m):m.isLineBasicMaterial?(o(p,m),m.isLineDashedMaterial&&a(p,m)):m.isPointsMaterial?l(p,m,y,R):m.isSpriteMaterial?c(p,m):m.isShadowMaterial?(p.color.value.copy(m.color),p.opacity.value=m.opacity):m.isShaderMaterial&&(m.uniformsNeedUpdate=!1)}function r(p,m){p.opacity.value=m.opacity,m.color&&p.diffuse.value.copy(m.color),m.emissive&&p.emissive.value.copy(m.emissive).multiplyScalar(m.emissiveIntensity),m.map&&(p.map.value=m.map,t(m.map,p.mapTransform)),m.alphaMap&&(p.alphaMap.value=m.alphaMap,t(m.alphaMap,p.alphaMapTransform)),m.bumpMap&&(p.bumpMap.value=m.bumpMap,t(m.bumpMap,p.bumpMapTransform),p.bumpScale.value=m.bumpScale,m.side===Jn&&(p.bumpScale.value*=-1)),m.normalMap&&(p.normalMap.value=m.normalMap,t(m.normalMap,p.normalMapTransform),p.normalScale.value.copy(m.normalScale),m.side===Jn&&p.normalScale.value.negate()),m.displacementMap&&(p.displacementMap.value=m.displacementMap,t(m.displacementMap,p.displacementMapTransform),p.displacementScale.value=m.displacementScale,p.displacementBias.value=m.displacementBias),m.emissiveMap&&(p.emissiveMap.value=m.emissiveMap,t(m.emissiveMap,p.emissiveMapTransform)),m.specularMap&&(p.specularMap.value=m.specularMap,t(m.specularMap,p.specularMapTransform)),m.alphaTest>0&&(p.alphaTest.value=m.alphaTest);let y=e.get(m),R=y.envMap,b=y.envMapRotation;R&&(p.envMap.value=R,p.envMapRotation.value.setFromMatrix4(KS.makeRotationFromEuler(b)).transpose(),R.isCubeTexture&&R.isRenderTargetTexture===!1&&p.envMapRotation.value.premultiply(km),p.reflectivity.value=m.reflectivity,p.ior.value=m.ior,p.refractionRatio.value=m.refractionRatio),m.lightMap&&(p.lightMap.value=m.lightMap,p.lightMapIntensity.value=m.lightMapIntensity,t(m.lightMap,p.lightMapTransform)),m.aoMap&&(p.aoMap.value=m.aoMap,p.aoMapIntensity.value=m.aoMapIntensity,t(m.aoMap,p.aoMapTransform))}function o(p,m){p.diffuse.value.copy(m.color),p.opacity.value=m.opacity,m.map&&(p.map.value=m.map,t(m.map,p.mapTransform))}function a(p,m){p.dashSize.value=m.dashSize,p.totalSize.value=m.dashSize+m.gapSize,p.scale.value=m.scale}function l(p,m,y,R){p.diffuse.value.copy(m.color),p.opacity.value=m.opacity,p.size.value=m.size*y,p.scale.value=R*.5,m.map&&(p.map.value=m.map,t(m.map,p.uvTransform)),m.alphaMap&&(p.alphaMap.value=m.alphaMap,t(m.alphaMap,p.alphaMapTransform)),m.alphaTest>0&&(p.alphaTest.value=m.alphaTest)}function c(p,m){p.diffuse.value.copy(m.color),p.opacity.value=m.opacity,p.rotation.value=m.rotation,m.map&&(p.map.value=m.map,t(m.map,p.mapTransform)),m.alphaMap&&(p.alphaMap.value=m.alphaMap,t(m.alphaMap,p.alphaMapTransform)),m.alphaTest>0&&(p.alphaTest.value=m.alphaTest)}function h(p,m){p.specular.value.copy(m.specular),p.shininess.value=Math.max(m.shininess,1e-4)}function u(p,m){m.gradientMap&&(p.gradientMap.value=m.gradientMap)}function d(p,m){p.metalness.value=m.metalness,m.metalnessMap&&(p.metalnessMap.value=m.metalnessMap,t(m.metalnessMap,p.metalnessMapTransform)),p.roughness.value=m.roughness,m.roughnessMap&&(p.roughnessMap.value=m.roughnessMap,t(m.roughnessMap,p.roughnessMapTransform)),m.envMap&&(p.envMapIntensity.value=m.envMapIntensity)}function f(p,m,y){p.ior.value=m.ior,m.diffuseRoughness>0&&(p.diffuseRoughness.value=m.diffuseRoughness,m.diffuseRoughnessMap&&(p.diffuseRoughnessMap.value=m.diffuseRoughnessMap,t(m.diffuseRoughnessMap,p.diffuseRoughnessMapTransform))),m.sheen>0&&(p.sheenColor.value.copy(m.sheenColor).multiplyScalar(m.sheen),p.sheenRoughness.value=m.sheenRoughness,m.sheenColorMap&&(p.sheenColorMap.value=m.sheenColorMap,t(m.sheenColorMap,p.sheenColorMapTransform)),m.sheenRoughnessMap&&(p.sheenRoughnessMap.value=m.sheenRoughnessMap,t(m.sheenRoughnessMap,p.sheenRoughnessMapTransform))),m.clearcoat>0&&(p.clearcoat.value=m.clearcoat,p.clearcoatRoughness.value=m.clearcoatRoughness,m.clearcoatMap&&(p.clearcoatMap.value=m.clearcoatMap,t(m.clearcoatMap,p.clearcoatMapTransform)),m.clearcoatRoughnessMap&&(p.clearcoatRoughnessMap.value=m.clearcoatRoughnessMap,t(m.clearcoatRoughnessMap,p.clearcoatRoughnessMapTransform)),m.clearcoatNormalMap&&(p.clearcoatNormalMap.value=m.clearcoatNormalMap,t(m.clearcoatNormalMap,p.clearcoatNormalMapTransform),p.clearcoatNormalScale.value.copy(m.clearcoatNormalScale),m.side===Jn&&p.clearcoatNormalScale.value.negate())),m.dispersion>0&&(p.dispersion.value=m.dispersion),m.retroreflectivity>0&&(p.retroreflectivity.value=m.retroreflectivity),m.iridescence>0&&(p.iridescence.value=m.iridescence,p.iridescenceIOR.value=m.iridescenceIOR,p.iridescenceThicknessMinimum.value=m.iridescenceThicknessMinimum,p.iridescenceThicknessMaximum.value=m.iridescenceThicknessMaximum,m.iridescenceMap&&(p.iridescenceMap.value=m.iridescenceMap,t(m.iridescenceMap,p.iridescenceMapTransform)),m.iridescenceThicknessMap&&(p.iridescenceThicknessMap.value=m.iridescenceThicknessMap,t(m.iridescenceThicknessMap,p.iridescenceThicknessMapTransform))),m.transmission>0&&(p.transmission.value=m.transmission,p.transmissionSamplerMap.value=y.texture,p.transmissionSamplerSize.value.set(y.width,y.height),m.transmissionMap&&(p.transmissionMap.value=m.transmissionMap,t(m.transmissionMap,p.transmissionMapTransform)),p.thickness.value=m.thickness,m.thicknessMap&&(p.thicknessMap.value=m.thicknessMap,t(m.thicknessMap,p.thicknessMapTransform)),p.attenuationDistance.value=m.attenuationDistance,p.attenuationColor.value.copy(m.attenuationColor)),m.anisotropy>0&&(p.anisotropyVector.value.set(m.anisotropy*Math.cos(m.anisotropyRotation),m.anisotropy*Math.sin(m.anisotropyRotation)),m.anisotropyMap&&(p.anisotropyMap.value=m.anisotropyMap,t(m.anisotropyMap,p.anisotropyMapTransform))),p.specularIntensity.value=m.specularIntensity,p.specularColor.value.copy(m.specularColor),m.specularColorMap&&(p.specularColorMap.value=m.specularColorMap,t(m.specularColorMap,p.specularColorMapTransform)),m.specularIntensityMap&&(p.specularIntensityMap.value=m.specularIntensityMap,t(m.specularIntensityMap,p.specularIntensityMapTransform))}function g(p,m){m.matcap&&(p.matcap.value=m.matcap)}function v(p,m){let y=e.get(m).light;p.referencePosition.value.setFromMatrixPosition(y.matrixWorld),p.nearDistance.value=y.shadow.camera.near,p.farDistance.value=y.shadow.camera.far}return{refreshFogUniforms:n,refreshMaterialUniforms:s}}function jS(i,e,t,n){let s={},r={};function o(y,R){let b=R.program;n.uniformBlockBinding(y,b,s[y.id])}function a(y,R){let b=s[y.id];b===void 0&&(g(y),b=l(y),s[y.id]=b,y.addEventListener("dispose",p));let A=R.program;n.updateUBOMapping(y,A);let E=e.render.frame;r[y.id]!==E&&(c(y),r[y.id]=E)}function l(y){let R=i.createBuffer(),b=y.__size,A=y.usage;return i.bindBuffer(i.UNIFORM_BUFFER,R),i.bufferData(i.UNIFORM_BUFFER,b,A),i.bindBuffer(i.UNIFORM_BUFFER,null),R}function c(y){let R=s[y.id],b=y.uniforms,A=y.__cache;i.bindBuffer(i.UNIFORM_BUFFER,R);for(let E=0,_=b.length;E<_;E++){let T=b[E];if(Array.isArray(T))for(let O=0,I=T.length;O<I;O++)h(T[O],E,O,A);else h(T,E,0,A)}i.bindBuffer(i.UNIFORM_BUFFER,null)}function h(y,R,b,A){if(d(y,R,b,A)===!0){let E=y.__offset,_=y.value;if(Array.isArray(_)){let T=0;for(let O=0;O<_.length;O++){let I=_[O],L=v(I,!0);u(I,y.__data,T),T+=L.storage/Float32Array.BYTES_PER_ELEMENT}}else u(_,y.__data,0);i.bufferSubData(i.UNIFORM_BUFFER,E,y.__data)}}function u(y,R,b){typeof y=="number"||typeof y=="boolean"?R[b]=y:y.isMatrix3?(R[b]=y.elements[0],R[b+1]=y.elements[1],R[b+2]=y.elements[2],R[b+3]=0,R[b+4]=y.elements[3],R[b+5]=y.elements[4],R[b+6]=y.elements[5],R[b+7]=0,R[b+8]=y.elements[6],R[b+9]=y.elements[7],R[b+10]=y.elements[8],R[b+11]=0):ArrayBuffer.isView(y)?R.set(y.subarray(0,R.length-b),b):y.toArray(R,b)}function d(y,R,b,A){let E=y.value,_=R+"_"+b;if(Array.isArray(E)){A[_]===void 0&&(A[_]=[]);let T=A[_],O=!1;for(let I=0;I<E.length;I++)f(E[I],T,I)===!0&&(O=!0);return O}return f(E,A,_)}function f(y,R,b){if(R[b]===void 0)return typeof y=="number"||typeof y=="boolean"?R[b]=y:ArrayBuffer.isView(y)?R[b]=y.slice():R[b]=y.clone(),!0;{let A=R[b];if(typeof y=="number"||typeof y=="boolean"){if(A!==y)return R[b]=y,!0}else{if(ArrayBuffer.isView(y))return!0;if(A.equals(y)===!1)return A.copy(y),!0}}return!1}function g(y){let R=y.uniforms,b=0,A=16;for(let _=0,T=R.length;_<T;_++){let O=Array.isArray(R[_])?R[_]:[R[_]];for(let I=0,L=O.length;I<L;I++){let H=O[I],V=Array.isArray(H.value)?H.value:[H.value],N=Array.isArray(R[_])||Array.isArray(H.value),X=b;for(let W=0,ce=V.length;W<ce;W++){let J=V[W],Q=v(J,N),se=b%A,de=se%Q.boundary,ue=se+de;b+=de,ue!==0&&A-ue<Q.storage&&(b+=A-ue),W===0&&(X=b),b+=Q.storage}let $=H.type==="int"?Int32Array:H.type==="uint"?Uint32Array:Float32Array;H.__data=new $((b-X)/Float32Array.BYTES_PER_ELEMENT),H.__offset=X}}let E=b%A;return E>0&&(b+=A-E),y.__size=b,y.__cache={},this}function v(y,R){let b={boundary:0,storage:0};return typeof y=="number"||typeof y=="boolean"?(b.boundary=4,b.storage=4):y.isVector2?(b.boundary=8,b.storage=8):y.isVector3||y.isColor?(b.boundary=16,b.storage=12):y.isVector4?(b.boundary=16,b.storage=16):y.isMatrix3?(b.boundary=16,b.storage=48):y.isMatrix4?(b.boundary=16,b.storage=64):y.isTexture?$e("WebGLRenderer: Texture samplers can not be part of an uniforms group."):ArrayBuffer.isView(y)?(b.boundary=16,b.storage=y.byteLength):$e("WebGLRenderer: Unsupported uniform value type.",y),R===!0&&(b.boundary=16,b.storage=Math.ceil(b.storage/16)*16),b}function p(y){let R=y.target;R.removeEventListener("dispose",p),i.deleteBuffer(s[R.id]),delete s[R.id],delete r[R.id]}function m(){for(let y in s)i.deleteBuffer(s[y]);s={},r={}}return{bind:o,update:a,dispose:m}}var QS=new Uint16Array([12469,15057,12620,14925,13266,14620,13807,14376,14323,13990,14545,13625,14713,13328,14840,12882,14931,12528,14996,12233,15039,11829,15066,11525,15080,11295,15085,10976,15082,10705,15073,10495,13880,14564,13898,14542,13977,14430,14158,14124,14393,13732,14556,13410,14702,12996,14814,12596,14891,12291,14937,11834,14957,11489,14958,11194,14943,10803,14921,10506,14893,10278,14858,9960,14484,14039,14487,14025,14499,13941,14524,13740,14574,13468,14654,13106,14743,12678,14818,12344,14867,11893,14889,11509,14893,11180,14881,10751,14852,10428,14812,10128,14765,9754,14712,9466,14764,13480,14764,13475,14766,13440,14766,13347,14769,13070,14786,12713,14816,12387,14844,11957,14860,11549,14868,11215,14855,10751,14825,10403,14782,10044,14729,9651,14666,9352,14599,9029,14967,12835,14966,12831,14963,12804,14954,12723,14936,12564,14917,12347,14900,11958,14886,11569,14878,11247,14859,10765,14828,10401,14784,10011,14727,9600,14660,9289,14586,8893,14508,8533,15111,12234,15110,12234,15104,12216,15092,12156,15067,12010,15028,11776,14981,11500,14942,11205,14902,10752,14861,10393,14812,9991,14752,9570,14682,9252,14603,8808,14519,8445,14431,8145,15209,11449,15208,11451,15202,11451,15190,11438,15163,11384,15117,11274,15055,10979,14994,10648,14932,10343,14871,9936,14803,9532,14729,9218,14645,8742,14556,8381,14461,8020,14365,7603,15273,10603,15272,10607,15267,10619,15256,10631,15231,10614,15182,10535,15118,10389,15042,10167,14963,9787,14883,9447,14800,9115,14710,8665,14615,8318,14514,7911,14411,7507,14279,7198,15314,9675,15313,9683,15309,9712,15298,9759,15277,9797,15229,9773,15166,9668,15084,9487,14995,9274,14898,8910,14800,8539,14697,8234,14590,7790,14479,7409,14367,7067,14178,6621,15337,8619,15337,8631,15333,8677,15325,8769,15305,8871,15264,8940,15202,8909,15119,8775,15022,8565,14916,8328,14804,8009,14688,7614,14569,7287,14448,6888,14321,6483,14088,6171,15350,7402,15350,7419,15347,7480,15340,7613,15322,7804,15287,7973,15229,8057,15148,8012,15046,7846,14933,7611,14810,7357,14682,7069,14552,6656,14421,6316,14251,5948,14007,5528,15356,5942,15356,5977,15353,6119,15348,6294,15332,6551,15302,6824,15249,7044,15171,7122,15070,7050,14949,6861,14818,6611,14679,6349,14538,6067,14398,5651,14189,5311,13935,4958,15359,4123,15359,4153,15356,4296,15353,4646,15338,5160,15311,5508,15263,5829,15188,6042,15088,6094,14966,6001,14826,5796,14678,5543,14527,5287,14377,4985,14133,4586,13869,4257,15360,1563,15360,1642,15358,2076,15354,2636,15341,3350,15317,4019,15273,4429,15203,4732,15105,4911,14981,4932,14836,4818,14679,4621,14517,4386,14359,4156,14083,3795,13808,3437,15360,122,15360,137,15358,285,15355,636,15344,1274,15322,2177,15281,2765,15215,3223,15120,3451,14995,3569,14846,3567,14681,3466,14511,3305,14344,3121,14037,2800,13753,2467,15360,0,15360,1,15359,21,15355,89,15346,253,15325,479,15287,796,15225,1148,15133,1492,15008,1749,14856,1882,14685,1886,14506,1783,14324,1608,13996,1398,13702,1183]),os=null;function eM(){return os===null&&(os=new mi(QS,16,16,sr,Vi),os.name="DFG_LUT",os.minFilter=Fn,os.magFilter=Fn,os.wrapS=ts,os.wrapT=ts,os.generateMipmaps=!1,os.needsUpdate=!0),os}var Yc=class{constructor(e={}){let{canvas:t=Qp(),context:n=null,depth:s=!0,stencil:r=!1,alpha:o=!1,antialias:a=!1,premultipliedAlpha:l=!0,preserveDrawingBuffer:c=!1,powerPreference:h="default",failIfMajorPerformanceCaveat:u=!1,reversedDepthBuffer:d=!1,outputBufferType:f=_i}=e;this.isWebGLRenderer=!0;let g;if(n!==null){if(typeof WebGLRenderingContext<"u"&&n instanceof WebGLRenderingContext)throw new Error("THREE.WebGLRenderer: WebGL 1 is not supported since r163.");g=n.getContextAttributes().alpha}else g=o;let v=f,p=new Set([yo,dc,uc]),m=new Set([_i,xi,xo,wr,lc,cc]),y=new Uint32Array(4),R=new Int32Array(4),b={textures:[],min:[],max:[],resolution:[]},A=null,E=null,_=[],T=[],O=null;this.domElement=t,this.debug={checkShaderErrors:!0,diagnostics:{keywords:!1},onShaderError:null},this.autoClear=!0,this.autoClearColor=!0,this.autoClearDepth=!0,this.autoClearStencil=!0,this.sortObjects=!0,this.clippingPlanes=[],this.localClippingEnabled=!1,this.toneMapping=rs,this.toneMappingExposure=1,this.transmissionResolutionScale=1;let I=this,L=!1,H=null,V=null,N=null,X=null;this._outputColorSpace=fi;let $=0,W=0,ce=null,J=-1,Q=null,se=new en,de=new en,ue=null,ee=new xt(0),me=0,_e=t.width,Ae=t.height,Se=1,Ge=null,st=null,He=new en(0,0,_e,Ae),ft=new en(0,0,_e,Ae),ct=!1,tt=new vr,Jt=new kl,Gt=!1,un=!1,Ut=new it,En=new k,wt=new en,xn={background:null,fog:null,environment:null,overrideMaterial:null,isScene:!0},tn=!1;function dn(){return ce===null?Se:1}let U=n;function Ce(w,z){return t.getContext(w,z)}let Ye,rt,Me,kt,ze,Xe,C,S,q,he,oe,ve,xe,te,ie,pe,F,re,ne,we,ge,be,Ve;try{let w={alpha:!0,depth:s,stencil:r,antialias:a,premultipliedAlpha:l,preserveDrawingBuffer:c,powerPreference:h,failIfMajorPerformanceCaveat:u};if("setAttribute"in t&&t.setAttribute("data-engine",`three.js r${"187"}`),t.addEventListener("webglcontextlost",Oe,!1),t.addEventListener("webglcontextrestored",Je,!1),t.addEventListener("webglcontextcreationerror",Re,!1),U===null){let z="webgl2";if(U=Ce(z,w),U===null)throw Ce(z)?new Error("THREE.WebGLRenderer: Error creating WebGL context with your selected attributes."):new Error("THREE.WebGLRenderer: Error creating WebGL context.")}Ke()}catch(w){throw t.removeEventListener("webglcontextlost",Oe,!1),t.removeEventListener("webglcontextrestored",Je,!1),t.removeEventListener("webglcontextcreationerror",Re,!1),Qe("WebGLRenderer: "+w.message),w}function Ke(){Ye=new ub(U),Ye.init(),ge=new YS(U,Ye),rt=new eb(U,Ye,e,ge),Me=new XS(U,Ye),rt.reversedDepthBuffer&&d&&Me.buffers.depth.setReversed(!0),V=U.createFramebuffer(),N=U.createFramebuffer(),X=U.createFramebuffer(),kt=new pb(U),ze=new IS,Xe=new qS(U,Ye,Me,ze,rt,ge,kt),C=new hb(I),S=new g_(U),be=new jy(U,S),q=new db(U,S,kt,be),he=new gb(U,q,S,be,kt),re=new mb(U,rt,Xe),ie=new tb(ze),oe=new PS(I,C,Ye,rt,be,ie),ve=new JS(I,ze),xe=new DS,te=new kS(Ye),F=new Jy(I,C,Me,he,g,l),pe=new WS(I,he,rt),Ve=new jS(U,kt,rt,Me),ne=new Qy(U,Ye,kt),we=new fb(U,Ye,kt),kt.programs=oe.programs,I.capabilities=rt,I.extensions=Ye,I.properties=ze,I.renderLists=xe,I.shadowMap=pe,I.state=Me,I.info=kt}v!==_i&&(O=new _b(v,t.width,t.height,a,s,r));let le=new gd(I,U);this.xr=le,this.getContext=function(){return U},this.getContextAttributes=function(){return U.getContextAttributes()},this.forceContextLoss=function(){let w=Ye.get("WEBGL_lose_context");w&&w.loseContext()},this.forceContextRestore=function(){let w=Ye.get("WEBGL_lose_context");w&&w.restoreContext()},this.getPixelRatio=function(){return Se},this.setPixelRatio=function(w){w!==void 0&&(Se=w,this.setSize(_e,Ae,!1))},this.getSize=function(w){return w.set(_e,Ae)},this.setSize=function(w,z,j=!0){if(le.isPresenting){$e("WebGLRenderer: Can't change size while VR device is presenting.");return}_e=w,Ae=z,t.width=Math.floor(w*Se),t.height=Math.floor(z*Se),j===!0&&(t.style.width=w+"px",t.style.height=z+"px"),O!==null&&O.setSize(t.width,t.height),this.setViewport(0,0,w,z)},this.getDrawingBufferSize=function(w){return w.set(_e*Se,Ae*Se).floor()},this.setDrawingBufferSize=function(w,z,j){_e=w,Ae=z,Se=j,t.width=Math.floor(w*j),t.height=Math.floor(z*j),this.setViewport(0,0,w,z)},this.setEffects=function(w){if(v===_i){Qe("WebGLRenderer: setEffects() requires outputBufferType set to HalfFloatType or FloatType.");return}if(w){for(let z=0;z<w.length;z++)if(w[z].isOutputPass===!0){$e("WebGLRenderer: OutputPass is not needed in setEffects(). Tone mapping and color space conversion are applied automatically.");break}}O.setEffects(w||[])},this.getCurrentViewport=function(w){return w.copy(se)},this.getViewport=function(w){return w.copy(He)},this.setViewport=function(w,z,j,Y){w.isVector4?He.set(w.x,w.y,w.z,w.w):He.set(w,z,j,Y),Me.viewport(se.copy(He).multiplyScalar(dn()).round())},this.getScissor=function(w){return w.copy(ft)},this.setScissor=function(w,z,j,Y){w.isVector4?ft.set(w.x,w.y,w.z,w.w):ft.set(w,z,j,Y),Me.scissor(de.copy(ft).multiplyScalar(dn()).round())},this.getScissorTest=function(){return ct},this.setScissorTest=function(w){Me.setScissorTest(ct=w)},this.setOpaqueSort=function(w){Ge=w},this.setTransparentSort=function(w){st=w},this.getClearColor=function(w){return w.copy(F.getClearColor())},this.setClearColor=function(){F.setClearColor(...arguments)},this.getClearAlpha=function(){return F.getClearAlpha()},this.setClearAlpha=function(){F.setClearAlpha(...arguments)},this.clear=function(w=!0,z=!0,j=!0){let Y=0;if(w){let Z=!1;if(ce!==null){let Ee=ce.texture.format;Z=p.has(Ee)}if(Z){let Ee=ce.texture.type,Pe=m.has(Ee),Te=F.getClearColor(),Ie=F.getClearAlpha(),ke=Te.r,je=Te.g,pt=Te.b;Pe?(y[0]=ke,y[1]=je,y[2]=pt,y[3]=Ie,U.clearBufferuiv(U.COLOR,0,y)):(R[0]=ke,R[1]=je,R[2]=pt,R[3]=Ie,U.clearBufferiv(U.COLOR,0,R))}else Y|=U.COLOR_BUFFER_BIT}z&&(Y|=U.DEPTH_BUFFER_BIT,this.state.buffers.depth.setMask(!0)),j&&(Y|=U.STENCIL_BUFFER_BIT,this.state.buffers.stencil.setMask(4294967295)),Y!==0&&U.clear(Y)},this.clearColor=function(){this.clear(!0,!1,!1)},this.clearDepth=function(){this.clear(!1,!0,!1)},this.clearStencil=function(){this.clear(!1,!1,!0)},this.setNodesHandler=function(w){w.setRenderer(this),H=w},this.dispose=function(){t.removeEventListener("webglcontextlost",Oe,!1),t.removeEventListener("webglcontextrestored",Je,!1),t.removeEventListener("webglcontextcreationerror",Re,!1),F.dispose(),xe.dispose(),te.dispose(),Xe.dispose(),ze.dispose(),C.dispose(),he.dispose(),q.dispose(),be.dispose(),Ve.dispose(),oe.dispose(),le.dispose(),le.removeEventListener("sessionstart",Xa),le.removeEventListener("sessionend",Yi),us.stop()};function Oe(w){w.preventDefault(),td("WebGLRenderer: Context Lost."),L=!0}function Je(){td("WebGLRenderer: Context Restored."),L=!1;let w=kt.autoReset,z=pe.enabled,j=pe.autoUpdate,Y=pe.needsUpdate,Z=pe.type;Ke(),kt.autoReset=w,pe.enabled=z,pe.autoUpdate=j,pe.needsUpdate=Y,pe.type=Z}function Re(w){Qe("WebGLRenderer: A WebGL context could not be created. Reason: ",w.statusMessage)}function ot(w){let z=w.target;z.removeEventListener("dispose",ot),Xt(z)}function Xt(w){Xn(w),ze.remove(w)}function Xn(w){let z=ze.get(w).programs;z!==void 0&&(z.forEach(function(j){oe.releaseProgram(j)}),w.isShaderMaterial&&oe.releaseShaderCache(w))}this.renderBufferDirect=function(w,z,j,Y,Z,Ee){z===null&&(z=xn);let Pe=Z.isMesh&&Z.matrixWorld.determinantAffine()<0,Te=zo(w,z,j,Y,Z);Me.setMaterial(Y,Pe);let Ie=j.index,ke=1;if(Y.wireframe===!0){if(Ie=q.getWireframeAttribute(j),Ie===void 0)return;ke=2}let je=j.drawRange,pt=j.attributes.position,Be=je.start*ke,mt=(je.start+je.count)*ke;Ee!==null&&(Be=Math.max(Be,Ee.start*ke),mt=Math.min(mt,(Ee.start+Ee.count)*ke)),Ie!==null?(Be=Math.max(Be,0),mt=Math.min(mt,Ie.count)):pt!=null&&(Be=Math.max(Be,0),mt=Math.min(mt,pt.count));let Qt=mt-Be;if(Qt<0||Qt===1/0)return;be.setup(Z,Y,Te,j,Ie);let Lt,Dt=ne;if(Ie!==null&&(Lt=S.get(Ie),Dt=we,Dt.setIndex(Lt)),Z.isMesh)Y.wireframe===!0?(Me.setLineWidth(Y.wireframeLinewidth*dn()),Dt.setMode(U.LINES)):Dt.setMode(U.TRIANGLES);else if(Z.isLine){let yn=Y.linewidth;yn===void 0&&(yn=1),Me.setLineWidth(yn*dn()),Z.isLineSegments?Dt.setMode(U.LINES):Z.isLineLoop?Dt.setMode(U.LINE_LOOP):Dt.setMode(U.LINE_STRIP)}else Z.isPoints?Dt.setMode(U.POINTS):Z.isSprite&&Dt.setMode(U.TRIANGLES);if(Z.isBatchedMesh)if(Ye.get("WEBGL_multi_draw"))Dt.renderMultiDraw(Z._multiDrawStarts,Z._multiDrawCounts,Z._multiDrawCount);else{let yn=Z._multiDrawStarts,Fe=Z._multiDrawCounts,fn=Z._multiDrawCount,bt=Ie?S.get(Ie).bytesPerElement:1,fs=ze.get(Y).currentProgram.getUniforms();for(let pn=0;pn<fn;pn++)fs.setValue(U,"_gl_DrawID",pn),Dt.render(yn[pn]/bt,Fe[pn])}else if(Z.isInstancedMesh)Dt.renderInstances(Be,Qt,Z.count);else if(j.isInstancedBufferGeometry){let yn=j._maxInstanceCount!==void 0?j._maxInstanceCount:1/0,Fe=Math.min(j.instanceCount,yn);Dt.renderInstances(Be,Qt,Fe)}else Dt.render(Be,Qt)};function Oo(w,z,j,Y){H!==null&&w.isNodeMaterial&&H.setObject(Y,w),Gt===!0&&ie.setState(w,j,!1),w.transparent===!0&&w.side===ln&&w.forceSinglePass===!1?(w.side=Jn,w.needsUpdate=!0,$i(w,z,Y),w.side=ss,w.needsUpdate=!0,$i(w,z,Y),w.side=ln):$i(w,z,Y)}this.compile=function(w,z,j=null){j===null&&(j=w),H!==null&&H.renderStart(w,z,j),E=te.get(j),E.init(z),T.push(E),j.traverseVisible(function(Z){Z.isLight&&Z.layers.test(z.layers)&&(E.pushLight(Z),Z.castShadow&&E.pushShadow(Z))}),w!==j&&w.traverseVisible(function(Z){Z.isLight&&Z.layers.test(z.layers)&&(E.pushLight(Z),Z.castShadow&&E.pushShadow(Z))}),E.setupLights(),H!==null&&H.updateLights(E.state.lightsArray),un=this.localClippingEnabled,Gt=ie.init(this.clippingPlanes,un),Gt===!0&&ie.setGlobalState(this.clippingPlanes,z),H!==null&&pe.render(E.state.shadowsArray,j,z);let Y=new Set;return w.traverse(function(Z){if(!(Z.isMesh||Z.isPoints||Z.isLine||Z.isSprite))return;let Ee=Z.material;if(Ee)if(Array.isArray(Ee))for(let Pe=0;Pe<Ee.length;Pe++){let Te=Ee[Pe];Oo(Te,j,z,Z),Y.add(Te)}else Oo(Ee,j,z,Z),Y.add(Ee)}),E=T.pop(),H!==null&&H.renderEnd(),Y},this.compileAsync=function(w,z,j=null){let Y=this.compile(w,z,j);return new Promise(Z=>{function Ee(){if(Y.forEach(function(Pe){let Ie=ze.get(Pe).currentProgram;(Ie===void 0||Ie.isReady())&&Y.delete(Pe)}),Y.size===0){Z(w);return}setTimeout(Ee,10)}Ye.get("KHR_parallel_shader_compile")!==null?Ee():setTimeout(Ee,10)})};let Nr=null;function Wh(w){Nr&&Nr(w)}function Xa(){us.stop()}function Yi(){us.start()}let us=new Cm;us.setAnimationLoop(Wh),typeof self<"u"&&us.setContext(self),this.setAnimationLoop=function(w){Nr=w,le.setAnimationLoop(w),w===null?us.stop():us.start()},le.addEventListener("sessionstart",Xa),le.addEventListener("sessionend",Yi),this.render=function(w,z){if(z!==void 0&&z.isCamera!==!0){Qe("WebGLRenderer.render: camera is not an instance of THREE.Camera.");return}if(L===!0)return;H!==null&&H.renderStart(w,z);let j=le.enabled===!0&&le.isPresenting===!0,Y=O!==null&&(ce===null||j)&&O.begin(I,ce);if(w.matrixWorldAutoUpdate===!0&&w.updateMatrixWorld(),z.parent===null&&z.matrixWorldAutoUpdate===!0&&z.updateMatrixWorld(),le.enabled===!0&&le.isPresenting===!0&&(O===null||O.isCompositing()===!1)&&(le.cameraAutoUpdate===!0&&le.updateCamera(z),z=le.getCamera()),w.isScene===!0&&w.onBeforeRender(I,w,z,ce),E=te.get(w,T.length),E.init(z),E.state.textureUnits=Xe.getTextureUnits(),T.push(E),Ut.multiplyMatrices(z.projectionMatrix,z.matrixWorldInverse),z.isArrayCamera?Jt.setFromArrayCamera(z):tt.setFromProjectionMatrix(Ut,Ci,z.reversedDepth),un=this.localClippingEnabled,Gt=ie.init(this.clippingPlanes,un),A=xe.get(w,_.length),A.init(),_.push(A),this.info.render.frame++,le.enabled===!0&&le.isPresenting===!0){let Pe=I.xr.getDepthSensingMesh();Pe!==null&&ds(Pe,z,-1/0,I.sortObjects)}ds(w,z,0,I.sortObjects),A.finish(),H!==null&&H.updateLights(E.state.lightsArray),I.sortObjects===!0&&A.sort(Ge,st),tn=le.enabled===!1||le.isPresenting===!1||le.hasDepthSensing()===!1,tn&&F.addToRenderList(A,w),this.info.autoReset===!0&&this.info.reset(),Gt===!0&&ie.beginShadows();let Z=E.state.shadowsArray;if(pe.render(Z,w,z),Gt===!0&&ie.endShadows(),(Y&&O.hasRenderPass())===!1){let Pe=A.opaque,Te=A.transmissive;if(E.setupLights(),z.isArrayCamera){let Ie=z.cameras;if(Te.length>0)for(let ke=0,je=Ie.length;ke<je;ke++){let pt=Ie[ke];Di(Pe,Te,w,pt)}tn&&F.render(w);for(let ke=0,je=Ie.length;ke<je;ke++){let pt=Ie[ke];Bo(A,w,pt,pt.viewport)}}else Te.length>0&&Di(Pe,Te,w,z),tn&&F.render(w),Bo(A,w,z)}ce!==null&&W===0&&(Xe.updateMultisampleRenderTarget(ce),Xe.updateRenderTargetMipmap(ce)),Y&&O.end(I),w.isScene===!0&&w.onAfterRender(I,w,z),be.resetDefaultState(),J=-1,Q=null,T.pop(),T.length>0?(E=T[T.length-1],Xe.setTextureUnits(E.state.textureUnits),Gt===!0&&ie.setGlobalState(I.clippingPlanes,E.state.camera)):E=null,_.pop(),_.length>0?A=_[_.length-1]:A=null,H!==null&&H.renderEnd()};function ds(w,z,j,Y){if(w.visible===!1)return;if(w.layers.test(z.layers)){if(w.isGroup)j=w.renderOrder;else if(w.isLOD)w.autoUpdate===!0&&w.update(z);else if(w.isLight)E.pushLight(w),w.castShadow&&E.pushShadow(w);else if(w.isSprite){let Pe=z.isArrayCamera?Jt:tt;if(!w.frustumCulled||w.intersectsFrustum(Pe)){Y&&wt.setFromMatrixPosition(w.matrixWorld).applyMatrix4(Ut);let Te=he.update(w),Ie=w.material;Ie.visible&&A.push(w,Te,Ie,j,wt.z,null,z)}}else if(w.isMesh||w.isLine||w.isPoints){let Pe=z.isArrayCamera?Jt:tt;if(!w.frustumCulled||w.intersectsFrustum(Pe)){let Te=he.update(w),Ie=w.material;if(Y&&(w.boundingSphere!==void 0?(w.boundingSphere===null&&w.computeBoundingSphere(),wt.copy(w.boundingSphere.center)):(Te.boundingSphere===null&&Te.computeBoundingSphere(),wt.copy(Te.boundingSphere.center)),wt.applyMatrix4(w.matrixWorld).applyMatrix4(Ut)),Array.isArray(Ie)){let ke=Te.groups;for(let je=0,pt=ke.length;je<pt;je++){let Be=ke[je],mt=Ie[Be.materialIndex];mt&&mt.visible&&A.push(w,Te,mt,j,wt.z,Be,z)}}else Ie.visible&&A.push(w,Te,Ie,j,wt.z,null,z)}}}let Ee=w.children;for(let Pe=0,Te=Ee.length;Pe<Te;Pe++)ds(Ee[Pe],z,j,Y)}function Bo(w,z,j,Y){let{opaque:Z,transmissive:Ee,transparent:Pe}=w;E.setupLightsView(j),Gt===!0&&ie.setGlobalState(I.clippingPlanes,j),Y&&Me.viewport(se.copy(Y)),Z.length>0&&nn(Z,z,j),Ee.length>0&&nn(Ee,z,j),Pe.length>0&&nn(Pe,z,j),Me.buffers.depth.setTest(!0),Me.buffers.depth.setMask(!0),Me.buffers.color.setMask(!0),Me.setPolygonOffset(!1)}function Di(w,z,j,Y){if((j.isScene===!0?j.overrideMaterial:null)!==null)return;if(E.state.transmissionRenderTarget[Y.id]===void 0){let Be=Ye.has("EXT_color_buffer_half_float")||Ye.has("EXT_color_buffer_float");E.state.transmissionRenderTarget[Y.id]=new Kn(1,1,{generateMipmaps:!0,type:Be?Vi:_i,minFilter:vi,samples:Math.max(4,rt.samples),stencilBuffer:r,resolveDepthBuffer:!1,resolveStencilBuffer:!1,storeMultisampledDepthBuffer:!1,storeMultisampledStencilBuffer:!1,colorSpace:gt.workingColorSpace})}let Ee=E.state.transmissionRenderTarget[Y.id],Pe=Y.viewport||se;Ee.setSize(Pe.z*I.transmissionResolutionScale,Pe.w*I.transmissionResolutionScale);let Te=I.getRenderTarget(),Ie=I.getActiveCubeFace(),ke=I.getActiveMipmapLevel();I.setRenderTarget(Ee),I.getClearColor(ee),me=I.getClearAlpha(),me<1&&I.setClearColor(16777215,.5),I.clear(),tn&&F.render(j);let je=I.toneMapping;I.toneMapping=rs;let pt=Y.viewport;if(Y.viewport!==void 0&&(Y.viewport=void 0),E.setupLightsView(Y),Gt===!0&&ie.setGlobalState(I.clippingPlanes,Y),nn(w,j,Y),Xe.updateMultisampleRenderTarget(Ee),Xe.updateRenderTargetMipmap(Ee),Ye.has("WEBGL_multisampled_render_to_texture")===!1){let Be=!1;for(let mt=0,Qt=z.length;mt<Qt;mt++){let Lt=z[mt],{object:Dt,geometry:yn,material:Fe,group:fn}=Lt;if(Fe.side===ln&&Dt.layers.test(Y.layers)){let bt=Fe.side;Fe.side=Jn,Fe.needsUpdate=!0,cn(Dt,j,Y,yn,Fe,fn),Fe.side=bt,Fe.needsUpdate=!0,Be=!0}}Be===!0&&(Xe.updateMultisampleRenderTarget(Ee),Xe.updateRenderTargetMipmap(Ee))}I.setRenderTarget(Te,Ie,ke),I.setClearColor(ee,me),pt!==void 0&&(Y.viewport=pt),I.toneMapping=je}function nn(w,z,j){let Y=z.isScene===!0?z.overrideMaterial:null;for(let Z=0,Ee=w.length;Z<Ee;Z++){let Pe=w[Z],{object:Te,geometry:Ie,group:ke}=Pe,je=Pe.material;je.allowOverride===!0&&Y!==null&&(je=Y),Te.layers.test(j.layers)&&cn(Te,z,j,Ie,je,ke)}}function cn(w,z,j,Y,Z,Ee){H!==null&&Z.isNodeMaterial&&H.setObject(w,Z),w.onBeforeRender(I,z,j,Y,Z,Ee),w.modelViewMatrix.multiplyMatrices(j.matrixWorldInverse,w.matrixWorld),w.normalMatrix.getNormalMatrix(w.modelViewMatrix),Z.onBeforeRender(I,z,j,Y,w,Ee),Z.transparent===!0&&Z.side===ln&&Z.forceSinglePass===!1?(Z.side=Jn,Z.needsUpdate=!0,I.renderBufferDirect(j,z,Y,Z,w,Ee),Z.side=ss,Z.needsUpdate=!0,I.renderBufferDirect(j,z,Y,Z,w,Ee),Z.side=ln):I.renderBufferDirect(j,z,Y,Z,w,Ee),w.onAfterRender(I,z,j,Y,Z,Ee)}function hn(w){let z=0;for(let j of w)j.texture!==null&&z++;return z}function $i(w,z,j){z.isScene!==!0&&(z=xn);let Y=ze.get(w),Z=E.state.lights,Ee=E.state.shadowsArray,Pe=Z.state.version,Te=oe.getParameters(w,Z.state,Ee,z,j,E.state.lightProbeGridArray),Ie=oe.getProgramCacheKey(Te),ke=Y.programs;Y.environment=w.isMeshStandardMaterial||w.isMeshLambertMaterial||w.isMeshPhongMaterial?z.environment:null,Y.fog=z.fog;let je=w.isMeshStandardMaterial||w.isMeshLambertMaterial&&!w.envMap||w.isMeshPhongMaterial&&!w.envMap;Y.envMap=C.get(w.envMap||Y.environment,je),Y.envMapRotation=Y.environment!==null&&w.envMap===null?z.environmentRotation:w.envMapRotation,ke===void 0&&(w.addEventListener("dispose",ot),ke=new Map,Y.programs=ke,Y.programVariants=new Map);let pt=ke.get(Ie);if(pt!==void 0){if(Y.currentProgram===pt&&Y.lightsStateVersion===Pe)return ko(w,Te),pt}else Te.uniforms=oe.getUniforms(w),H!==null&&w.isNodeMaterial&&H.build(w,j,Te),w.onBeforeCompile(Te,I),pt=oe.acquireProgram(Te,Ie),ke.set(Ie,pt),Y.uniforms=Te.uniforms;let Be=Y.uniforms;return(!w.isShaderMaterial&&!w.isRawShaderMaterial||w.clipping===!0)&&(Be.clippingPlanes=ie.uniform),ko(w,Te),Y.needsLights=Us(w),Y.lightsStateVersion=Pe,Y.needsLights&&(Be.ambientLightColor.value=Z.state.ambient,Be.lightProbe.value=Z.state.probe,Be.sunLights.value=Z.state.sun,Be.sunLightShadows.value=Z.state.sunShadow,Be.directionalLights.value=Z.state.directional,Be.directionalLightShadows.value=Z.state.directionalShadow,Be.spotLights.value=Z.state.spot,Be.spotLightShadows.value=Z.state.spotShadow,Be.rectAreaLights.value=Z.state.rectArea,Be.ltc_1.value=Z.state.rectAreaLTC1,Be.ltc_2.value=Z.state.rectAreaLTC2,Be.pointLights.value=Z.state.point,Be.pointLightShadows.value=Z.state.pointShadow,Be.hemisphereLights.value=Z.state.hemi,Be.sunShadowMatrix.value=Z.state.sunShadowMatrix,Be.sunShadowCascade.value=Z.state.sunShadowCascade,Be.directionalShadowMatrix.value=Z.state.directionalShadowMatrix,Be.spotLightMatrix.value=Z.state.spotLightMatrix,Be.spotLightMap.value=Z.state.spotLightMap,Be.pointShadowMatrix.value=Z.state.pointShadowMatrix),Y.numLightProbeGrids=hn(E.state.lightProbeGridArray),Y.currentProgram=pt,Y.uniformsList=null,pt}function oi(w,z,j,Y,Z){let Ee=ze.get(w),Pe=Ee.currentProgram.id+","+Y+","+Z,Te=Ee.programVariants.get(Pe);return Te===void 0?(Te=$i(w,z,j),Ee.programVariants.set(Pe,Te)):(Ee.currentProgram=Te,Ee.uniformsList=null,Ee.outputColorSpace=Y,Ee.toneMapping=Z),Te}function Fs(w){if(w.uniformsList===null){let z=w.currentProgram.getUniforms();w.uniformsList=bo.seqWithValue(z.seq,w.uniforms)}return w.uniformsList}function ko(w,z){let j=ze.get(w);j.outputColorSpace=z.outputColorSpace,j.batching=z.batching,j.batchingColor=z.batchingColor,j.instancing=z.instancing,j.instancingColor=z.instancingColor,j.instancingMorph=z.instancingMorph,j.skinning=z.skinning,j.morphTargets=z.morphTargets,j.morphNormals=z.morphNormals,j.morphColors=z.morphColors,j.morphTargetsCount=z.morphTargetsCount,j.numClippingPlanes=z.numClippingPlanes,j.numIntersection=z.numClipIntersection,j.vertexAlphas=z.vertexAlphas,j.vertexTangents=z.vertexTangents,j.toneMapping=z.toneMapping}function zo(w,z,j,Y,Z){z.isScene!==!0&&(z=xn),Xe.resetTextureUnits();let Ee=z.fog,Pe=Y.isMeshStandardMaterial||Y.isMeshLambertMaterial||Y.isMeshPhongMaterial?z.environment:null,Te=ce===null?I.outputColorSpace:ce.isXRRenderTarget===!0?ce.texture.colorSpace:gt.workingColorSpace,Ie=Y.isMeshStandardMaterial||Y.isMeshLambertMaterial&&!Y.envMap||Y.isMeshPhongMaterial&&!Y.envMap,ke=C.get(Y.envMap||Pe,Ie),je=Y.vertexColors===!0&&!!j.attributes.color&&j.attributes.color.itemSize===4,pt=!!j.attributes.tangent&&(!!Y.normalMap||Y.anisotropy>0),Be=!!j.morphAttributes.position,mt=!!j.morphAttributes.normal,Qt=!!j.morphAttributes.color,Lt=rs;Y.toneMapped&&(ce===null||ce.isXRRenderTarget===!0)&&(Lt=I.toneMapping);let Dt=j.morphAttributes.position||j.morphAttributes.normal||j.morphAttributes.color,yn=Dt!==void 0?Dt.length:0,Fe=ze.get(Y),fn=E.state.lights;if(Gt===!0&&(un===!0||w!==Q)){let Nt=w===Q&&Y.id===J;ie.setState(Y,w,Nt)}let bt=!1,fs=!1;Y.version===Fe.__version?Fe.needsLights&&Fe.lightsStateVersion!==fn.state.version||Z.isBatchedMesh&&Fe.batching===!1||!Z.isBatchedMesh&&Fe.batching===!0||Z.isBatchedMesh&&Fe.batchingColor===!0&&Z._colorsTexture===null||Z.isBatchedMesh&&Fe.batchingColor===!1&&Z._colorsTexture!==null||Z.isInstancedMesh&&Fe.instancing===!1||!Z.isInstancedMesh&&Fe.instancing===!0||Z.isSkinnedMesh&&Fe.skinning===!1||!Z.isSkinnedMesh&&Fe.skinning===!0||Z.isInstancedMesh&&Fe.instancingColor===!0&&Z.instanceColor===null||Z.isInstancedMesh&&Fe.instancingColor===!1&&Z.instanceColor!==null||Z.isInstancedMesh&&Fe.instancingMorph===!0&&Z.morphTexture===null||Z.isInstancedMesh&&Fe.instancingMorph===!1&&Z.morphTexture!==null||Fe.envMap!==ke||Y.fog===!0&&Fe.fog!==Ee||Fe.numClippingPlanes!==void 0&&(Fe.numClippingPlanes!==ie.numPlanes||Fe.numIntersection!==ie.numIntersection)||Fe.vertexAlphas!==je||Fe.vertexTangents!==pt||Fe.morphTargets!==Be||Fe.morphNormals!==mt||Fe.morphColors!==Qt||Fe.morphTargetsCount!==yn||Fe.numLightProbeGrids!==hn(E.state.lightProbeGridArray)?bt=!0:(Fe.outputColorSpace!==Te||Fe.toneMapping!==Lt)&&(fs=!0):(bt=!0,Fe.__version=Y.version);let pn=Fe.currentProgram;(bt===!0||fs===!0)&&(pn=fs===!0?oi(Y,z,Z,Te,Lt):$i(Y,z,Z),H&&Y.isNodeMaterial&&H.onUpdateProgram(Y,pn,Fe));let Or=!1,Zi=!1,ps=!1,ht=pn.getUniforms(),sn=Fe.uniforms;if(Me.useProgram(pn.program)&&(Or=!0,Zi=!0,ps=!0),Y.id!==J&&(J=Y.id,Zi=!0),Or||Q!==w){Me.buffers.depth.getReversed()&&w.reversedDepth!==!0&&(w._reversedDepth=!0,w.updateProjectionMatrix()),ht.setValue(U,"projectionMatrix",w.projectionMatrix),ht.setValue(U,"viewMatrix",w.matrixWorldInverse);let mn=ht.map.cameraPosition;mn!==void 0&&mn.setValue(U,En.setFromMatrixPosition(w.matrixWorld)),rt.logarithmicDepthBuffer&&ht.setValue(U,"logDepthBufFC",2/(Math.log(w.far+1)/Math.LN2)),(Y.isMeshPhongMaterial||Y.isMeshToonMaterial||Y.isMeshLambertMaterial||Y.isMeshBasicMaterial||Y.isMeshStandardMaterial||Y.isShaderMaterial)&&ht.setValue(U,"isOrthographic",w.isOrthographicCamera===!0),Q!==w&&(Q=w,Zi=!0,ps=!0)}if(Fe.needsLights&&(fn.state.sunShadowMap.length>0&&ht.setValue(U,"sunShadowMap",fn.state.sunShadowMap,Xe),fn.state.directionalShadowMap.length>0&&ht.setValue(U,"directionalShadowMap",fn.state.directionalShadowMap,Xe),fn.state.spotShadowMap.length>0&&ht.setValue(U,"spotShadowMap",fn.state.spotShadowMap,Xe),fn.state.pointShadowMap.length>0&&ht.setValue(U,"pointShadowMap",fn.state.pointShadowMap,Xe)),Z.isSkinnedMesh){ht.setOptional(U,Z,"bindMatrix"),ht.setOptional(U,Z,"bindMatrixInverse");let Nt=Z.skeleton;Nt&&(Nt.boneTexture===null&&Nt.computeBoneTexture(),ht.setValue(U,"boneTexture",Nt.boneTexture,Xe))}Z.isBatchedMesh&&(ht.setOptional(U,Z,"batchingTexture"),ht.setValue(U,"batchingTexture",Z._matricesTexture,Xe),ht.setOptional(U,Z,"batchingIdTexture"),ht.setValue(U,"batchingIdTexture",Z._indirectTexture,Xe),ht.setOptional(U,Z,"batchingColorTexture"),Z._colorsTexture!==null&&ht.setValue(U,"batchingColorTexture",Z._colorsTexture,Xe));let qn=j.morphAttributes;if((qn.position!==void 0||qn.normal!==void 0||qn.color!==void 0)&&re.update(Z,j,pn),(Zi||Fe.receiveShadow!==Z.receiveShadow)&&(Fe.receiveShadow=Z.receiveShadow,ht.setValue(U,"receiveShadow",Z.receiveShadow)),(Y.isMeshStandardMaterial||Y.isMeshLambertMaterial||Y.isMeshPhongMaterial)&&Y.envMap===null&&z.environment!==null&&(sn.envMapIntensity.value=z.environmentIntensity),sn.dfgLUT!==void 0&&(sn.dfgLUT.value=eM()),Zi){if(ht.setValue(U,"toneMappingExposure",I.toneMappingExposure),Fe.needsLights&&Fr(sn,ps),Ee&&Y.fog===!0&&ve.refreshFogUniforms(sn,Ee),ve.refreshMaterialUniforms(sn,Y,Se,Ae,E.state.transmissionRenderTarget[w.id]),Fe.needsLights&&Fe.numLightProbeGrids>0){let Nt=b,mn=0;for(let Bn of E.state.lightProbeGridArray)Bn.texture!==null&&(Nt.textures[mn]=Bn.texture,Nt.min[mn]=Bn.boundingBox.min,Nt.max[mn]=Bn.boundingBox.max,Nt.resolution[mn]=Bn.resolution,mn++);for(let Bn in Nt)Nt[Bn].length=mn;sn.probesSH.value=Nt.textures,sn.probesMin.value=Nt.min,sn.probesMax.value=Nt.max,sn.probesResolution.value=Nt.resolution}bo.upload(U,Fs(Fe),sn,Xe)}if(Y.isShaderMaterial&&Y.uniformsNeedUpdate===!0&&(bo.upload(U,Fs(Fe),sn,Xe),Y.uniformsNeedUpdate=!1),Y.isSpriteMaterial&&ht.setValue(U,"center",Z.center),ht.setValue(U,"modelViewMatrix",Z.modelViewMatrix),ht.setValue(U,"normalMatrix",Z.normalMatrix),ht.setValue(U,"modelMatrix",Z.matrixWorld),Y.uniformsGroups!==void 0){let Nt=Y.uniformsGroups;for(let mn=0,Bn=Nt.length;mn<Bn;mn++){let qa=Nt[mn];Ve.update(qa,pn),Ve.bind(qa,pn)}}return pn}function Fr(w,z){w.ambientLightColor.needsUpdate=z,w.lightProbe.needsUpdate=z,w.sunLights.needsUpdate=z,w.sunLightShadows.needsUpdate=z,w.directionalLights.needsUpdate=z,w.directionalLightShadows.needsUpdate=z,w.pointLights.needsUpdate=z,w.pointLightShadows.needsUpdate=z,w.spotLights.needsUpdate=z,w.spotLightShadows.needsUpdate=z,w.rectAreaLights.needsUpdate=z,w.hemisphereLights.needsUpdate=z}function Us(w){return w.isMeshLambertMaterial||w.isMeshToonMaterial||w.isMeshPhongMaterial||w.isMeshStandardMaterial||w.isShadowMaterial||w.isShaderMaterial&&w.lights===!0}this.getActiveCubeFace=function(){return $},this.getActiveMipmapLevel=function(){return W},this.getRenderTarget=function(){return ce},this.setRenderTargetTextures=function(w,z,j){let Y=ze.get(w);Y.__autoAllocateDepthBuffer=w.resolveDepthBuffer===!1,Y.__autoAllocateDepthBuffer===!1&&(Y.__useRenderToTexture=!1),ze.get(w.texture).__webglTexture=z,ze.get(w.depthTexture).__webglTexture=Y.__autoAllocateDepthBuffer?void 0:j,Y.__hasExternalTextures=!0},this.setRenderTargetFramebuffer=function(w,z){let j=ze.get(w);j.__webglFramebuffer=z,j.__useDefaultFramebuffer=z===void 0},this.setRenderTarget=function(w,z=0,j=0){ce=w,$=z,W=j;let Y=null,Z=!1,Ee=!1;if(w){let Te=ze.get(w);if(Te.__useDefaultFramebuffer!==void 0){Me.bindFramebuffer(U.FRAMEBUFFER,Te.__webglFramebuffer),se.copy(w.viewport),de.copy(w.scissor),ue=w.scissorTest,Me.viewport(se),Me.scissor(de),Me.setScissorTest(ue),J=-1;return}else if(Te.__webglFramebuffer===void 0)Xe.setupRenderTarget(w);else if(Te.__hasExternalTextures)Xe.rebindTextures(w,ze.get(w.texture).__webglTexture,ze.get(w.depthTexture).__webglTexture);else if(w.depthBuffer){let je=w.depthTexture;if(Te.__boundDepthTexture!==je){if(je!==null&&ze.has(je)&&(w.width!==je.image.width||w.height!==je.image.height))throw new Error("THREE.WebGLRenderer: Attached DepthTexture is initialized to the incorrect size.");Xe.setupDepthRenderbuffer(w)}}let Ie=w.texture;(Ie.isData3DTexture||Ie.isDataArrayTexture||Ie.isCompressedArrayTexture)&&(Ee=!0);let ke=ze.get(w).__webglFramebuffer;w.isWebGLCubeRenderTarget?(Array.isArray(ke[z])?Y=ke[z][j]:Y=ke[z],Z=!0):w.samples>0&&Xe.useMultisampledRTT(w)===!1?Y=ze.get(w).__webglMultisampledFramebuffer:Array.isArray(ke)?Y=ke[j]:Y=ke,se.copy(w.viewport),de.copy(w.scissor),ue=w.scissorTest}else se.copy(He).multiplyScalar(Se).floor(),de.copy(ft).multiplyScalar(Se).floor(),ue=ct;if(j!==0&&(Y=V),Me.bindFramebuffer(U.FRAMEBUFFER,Y)&&Me.drawBuffers(w,Y),Me.viewport(se),Me.scissor(de),Me.setScissorTest(ue),Z){let Te=ze.get(w.texture);U.framebufferTexture2D(U.FRAMEBUFFER,U.COLOR_ATTACHMENT0,U.TEXTURE_CUBE_MAP_POSITIVE_X+z,Te.__webglTexture,j)}else if(Ee){let Te=z;for(let Ie=0;Ie<w.textures.length;Ie++){let ke=ze.get(w.textures[Ie]);U.framebufferTextureLayer(U.FRAMEBUFFER,U.COLOR_ATTACHMENT0+Ie,ke.__webglTexture,j,Te)}}else if(w!==null&&j!==0){let Te=ze.get(w.texture);U.framebufferTexture2D(U.FRAMEBUFFER,U.COLOR_ATTACHMENT0,U.TEXTURE_2D,Te.__webglTexture,j)}J=-1};function Ur(w){let z=ze.get(w);return(z.__readFormat!==w.format||z.__readType!==w.type)&&(z.__readFormat=w.format,z.__readType=w.type,z.__formatReadable=rt.textureFormatReadable(w.format),z.__typeReadable=rt.textureTypeReadable(w.type)),z}this.readRenderTargetPixels=function(w,z,j,Y,Z,Ee,Pe,Te=0){if(!(w&&w.isWebGLRenderTarget)){Qe("WebGLRenderer.readRenderTargetPixels: renderTarget is not THREE.WebGLRenderTarget.");return}let Ie=ze.get(w).__webglFramebuffer;if(w.isWebGLCubeRenderTarget&&Pe!==void 0&&(Ie=Ie[Pe],Array.isArray(Ie)&&(Ie=Ie[0])),Ie){Me.bindFramebuffer(U.FRAMEBUFFER,Ie);try{let ke=w.textures[Te],je=ke.format,pt=ke.type;w.textures.length>1&&U.readBuffer(U.COLOR_ATTACHMENT0+Te);let Be=Ur(ke);if(Be.__formatReadable===!1){Qe("WebGLRenderer.readRenderTargetPixels: renderTarget is not in RGBA or implementation defined format.");return}if(Be.__typeReadable===!1){Qe("WebGLRenderer.readRenderTargetPixels: renderTarget is not in UnsignedByteType or implementation defined type.");return}z>=0&&z<=w.width-Y&&j>=0&&j<=w.height-Z&&U.readPixels(z,j,Y,Z,ge.convert(je),ge.convert(pt),Ee)}finally{let ke=ce!==null?ze.get(ce).__webglFramebuffer:null;Me.bindFramebuffer(U.FRAMEBUFFER,ke)}}},this.readRenderTargetPixelsAsync=async function(w,z,j,Y,Z,Ee,Pe,Te=0){if(!(w&&w.isWebGLRenderTarget))throw new Error("THREE.WebGLRenderer.readRenderTargetPixels: renderTarget is not THREE.WebGLRenderTarget.");let Ie=ze.get(w).__webglFramebuffer;if(w.isWebGLCubeRenderTarget&&Pe!==void 0&&(Ie=Ie[Pe],Array.isArray(Ie)&&(Ie=Ie[0])),Ie)if(z>=0&&z<=w.width-Y&&j>=0&&j<=w.height-Z){Me.bindFramebuffer(U.FRAMEBUFFER,Ie);let ke=w.textures[Te],je=ke.format,pt=ke.type;w.textures.length>1&&U.readBuffer(U.COLOR_ATTACHMENT0+Te);let Be=Ur(ke);if(Be.__formatReadable===!1)throw new Error("THREE.WebGLRenderer.readRenderTargetPixelsAsync: renderTarget is not in RGBA or implementation defined format.");if(Be.__typeReadable===!1)throw new Error("THREE.WebGLRenderer.readRenderTargetPixelsAsync: renderTarget is not in UnsignedByteType or implementation defined type.");let mt=U.createBuffer();U.bindBuffer(U.PIXEL_PACK_BUFFER,mt),U.bufferData(U.PIXEL_PACK_BUFFER,Ee.byteLength,U.STREAM_READ),U.readPixels(z,j,Y,Z,ge.convert(je),ge.convert(pt),0),U.bindBuffer(U.PIXEL_PACK_BUFFER,null);let Qt=ce!==null?ze.get(ce).__webglFramebuffer:null;Me.bindFramebuffer(U.FRAMEBUFFER,Qt);let Lt=U.fenceSync(U.SYNC_GPU_COMMANDS_COMPLETE,0);return U.flush(),await tm(U,Lt,4),U.bindBuffer(U.PIXEL_PACK_BUFFER,mt),U.getBufferSubData(U.PIXEL_PACK_BUFFER,0,Ee),U.bindBuffer(U.PIXEL_PACK_BUFFER,null),U.deleteBuffer(mt),U.deleteSync(Lt),Ee}else throw new Error("THREE.WebGLRenderer.readRenderTargetPixelsAsync: requested read bounds are out of range.")},this.copyFramebufferToTexture=function(w,z=null,j=0){let Y=Math.pow(2,-j),Z=Math.floor(w.image.width*Y),Ee=Math.floor(w.image.height*Y),Pe=z!==null?z.x:0,Te=z!==null?z.y:0;Xe.setTexture2D(w,0),U.copyTexSubImage2D(U.TEXTURE_2D,j,0,0,Pe,Te,Z,Ee),Me.unbindTexture()},this.copyTextureToTexture=function(w,z,j=null,Y=null,Z=0,Ee=0){let Pe,Te,Ie,ke,je,pt,Be,mt,Qt,Lt=w.isCompressedTexture?w.mipmaps[Ee]:w.image;if(j!==null)Pe=j.max.x-j.min.x,Te=j.max.y-j.min.y,Ie=j.isBox3?j.max.z-j.min.z:1,ke=j.min.x,je=j.min.y,pt=j.isBox3?j.min.z:0;else{let ht=Math.pow(2,-Z);Pe=Math.floor(Lt.width*ht),Te=Math.floor(Lt.height*ht),w.isDataArrayTexture?Ie=Lt.depth:w.isData3DTexture?Ie=Math.floor(Lt.depth*ht):Ie=1,ke=0,je=0,pt=0}Y!==null?(Be=Y.x,mt=Y.y,Qt=Y.z):(Be=0,mt=0,Qt=0);let Dt=ge.convert(z.format),yn=ge.convert(z.type),Fe;z.isData3DTexture?(Xe.setTexture3D(z,0),Fe=U.TEXTURE_3D):z.isDataArrayTexture||z.isCompressedArrayTexture?(Xe.setTexture2DArray(z,0),Fe=U.TEXTURE_2D_ARRAY):(Xe.setTexture2D(z,0),Fe=U.TEXTURE_2D),Me.activeTexture(U.TEXTURE0),Me.pixelStorei(U.UNPACK_FLIP_Y_WEBGL,z.flipY),Me.pixelStorei(U.UNPACK_PREMULTIPLY_ALPHA_WEBGL,z.premultiplyAlpha),Me.pixelStorei(U.UNPACK_ALIGNMENT,z.unpackAlignment);let fn=Me.getParameter(U.UNPACK_ROW_LENGTH),bt=Me.getParameter(U.UNPACK_IMAGE_HEIGHT),fs=Me.getParameter(U.UNPACK_SKIP_PIXELS),pn=Me.getParameter(U.UNPACK_SKIP_ROWS),Or=Me.getParameter(U.UNPACK_SKIP_IMAGES);Me.pixelStorei(U.UNPACK_ROW_LENGTH,Lt.width),Me.pixelStorei(U.UNPACK_IMAGE_HEIGHT,Lt.height),Me.pixelStorei(U.UNPACK_SKIP_PIXELS,ke),Me.pixelStorei(U.UNPACK_SKIP_ROWS,je),Me.pixelStorei(U.UNPACK_SKIP_IMAGES,pt);let Zi=w.isDataArrayTexture||w.isData3DTexture,ps=z.isDataArrayTexture||z.isData3DTexture;if(w.isDepthTexture){let ht=ze.get(w),sn=ze.get(z),qn=ze.get(ht.__renderTarget),Nt=ze.get(sn.__renderTarget);Me.bindFramebuffer(U.READ_FRAMEBUFFER,qn.__webglFramebuffer),Me.bindFramebuffer(U.DRAW_FRAMEBUFFER,Nt.__webglFramebuffer);for(let mn=0;mn<Ie;mn++)Zi&&(U.framebufferTextureLayer(U.READ_FRAMEBUFFER,U.COLOR_ATTACHMENT0,ze.get(w).__webglTexture,Z,pt+mn),U.framebufferTextureLayer(U.DRAW_FRAMEBUFFER,U.COLOR_ATTACHMENT0,ze.get(z).__webglTexture,Ee,Qt+mn)),U.blitFramebuffer(ke,je,ke+Pe,je+Te,Be,mt,Be+Pe,mt+Te,U.DEPTH_BUFFER_BIT,U.NEAREST);Me.bindFramebuffer(U.READ_FRAMEBUFFER,null),Me.bindFramebuffer(U.DRAW_FRAMEBUFFER,null)}else if(Z!==0||w.isRenderTargetTexture||ze.has(w)){let ht=ze.get(w),sn=ze.get(z);Me.bindFramebuffer(U.READ_FRAMEBUFFER,N),Me.bindFramebuffer(U.DRAW_FRAMEBUFFER,X);for(let qn=0;qn<Ie;qn++)Zi?U.framebufferTextureLayer(U.READ_FRAMEBUFFER,U.COLOR_ATTACHMENT0,ht.__webglTexture,Z,pt+qn):U.framebufferTexture2D(U.READ_FRAMEBUFFER,U.COLOR_ATTACHMENT0,U.TEXTURE_2D,ht.__webglTexture,Z),ps?U.framebufferTextureLayer(U.DRAW_FRAMEBUFFER,U.COLOR_ATTACHMENT0,sn.__webglTexture,Ee,Qt+qn):U.framebufferTexture2D(U.DRAW_FRAMEBUFFER,U.COLOR_ATTACHMENT0,U.TEXTURE_2D,sn.__webglTexture,Ee),Z!==0?U.blitFramebuffer(ke,je,ke+Pe,je+Te,Be,mt,Be+Pe,mt+Te,U.COLOR_BUFFER_BIT,U.NEAREST):ps?U.copyTexSubImage3D(Fe,Ee,Be,mt,Qt+qn,ke,je,Pe,Te):U.copyTexSubImage2D(Fe,Ee,Be,mt,ke,je,Pe,Te);Me.bindFramebuffer(U.READ_FRAMEBUFFER,null),Me.bindFramebuffer(U.DRAW_FRAMEBUFFER,null)}else ps?w.isDataTexture||w.isData3DTexture?U.texSubImage3D(Fe,Ee,Be,mt,Qt,Pe,Te,Ie,Dt,yn,Lt.data):z.isCompressedArrayTexture?U.compressedTexSubImage3D(Fe,Ee,Be,mt,Qt,Pe,Te,Ie,Dt,Lt.data):U.texSubImage3D(Fe,Ee,Be,mt,Qt,Pe,Te,Ie,Dt,yn,Lt):w.isDataTexture?U.texSubImage2D(U.TEXTURE_2D,Ee,Be,mt,Pe,Te,Dt,yn,Lt.data):w.isCompressedTexture?U.compressedTexSubImage2D(U.TEXTURE_2D,Ee,Be,mt,Lt.width,Lt.height,Dt,Lt.data):U.texSubImage2D(U.TEXTURE_2D,Ee,Be,mt,Pe,Te,Dt,yn,Lt);Me.pixelStorei(U.UNPACK_ROW_LENGTH,fn),Me.pixelStorei(U.UNPACK_IMAGE_HEIGHT,bt),Me.pixelStorei(U.UNPACK_SKIP_PIXELS,fs),Me.pixelStorei(U.UNPACK_SKIP_ROWS,pn),Me.pixelStorei(U.UNPACK_SKIP_IMAGES,Or),Ee===0&&z.generateMipmaps===!0&&z.mipmapsAutoUpdate===!0&&U.generateMipmap(Fe),Me.unbindTexture()},this.initRenderTarget=function(w){ze.get(w).__webglFramebuffer===void 0&&Xe.setupRenderTarget(w)},this.initTexture=function(w){w.isCubeTexture?Xe.setTextureCube(w,0):w.isData3DTexture?Xe.setTexture3D(w,0):w.isDataArrayTexture||w.isCompressedArrayTexture?Xe.setTexture2DArray(w,0):Xe.setTexture2D(w,0),Me.unbindTexture()},this.resetState=function(){$=0,W=0,ce=null,Me.reset(),be.reset()},typeof __THREE_DEVTOOLS__<"u"&&__THREE_DEVTOOLS__.dispatchEvent(new CustomEvent("observe",{detail:this}))}get coordinateSystem(){return Ci}get outputColorSpace(){return this._outputColorSpace}set outputColorSpace(e){this._outputColorSpace=e;let t=this.getContext();t.drawingBufferColorSpace=gt._getDrawingBufferColorSpace(e),t.unpackColorSpace=gt._getUnpackColorSpace()}};function ii(i,e,t){return i<e?e:i>t?t:i}function si(i,e){return[i[0]+e[0],i[1]+e[1],i[2]+e[2]]}function ls(i,e){return[i[0]-e[0],i[1]-e[1],i[2]-e[2]]}function bi(i,e){return[i[0]*e,i[1]*e,i[2]*e]}function Kc(i,e){return i[0]*e[0]+i[1]*e[1]+i[2]*e[2]}function zm(i,e){return[i[1]*e[2]-i[2]*e[1],i[2]*e[0]-i[0]*e[2],i[0]*e[1]-i[1]*e[0]]}function Ia(i){return Math.hypot(i[0],i[1],i[2])}function vd(i,e=[1,0,0]){let t=Ia(i);return t>0&&Number.isFinite(t)?bi(i,1/t):e}function Jc(i,e){let[t,n,s,r]=i,o=2*(s*e[2]-r*e[1]),a=2*(r*e[0]-n*e[2]),l=2*(n*e[1]-s*e[0]);return[e[0]+t*o+s*l-r*a,e[1]+t*a+r*o-n*l,e[2]+t*l+n*a-s*o]}function Hm(i,e,t){let n=i[0]*e[0]+i[1]*e[1]+i[2]*e[2]+i[3]*e[3]<0?-1:1,s=[0,0,0,0];for(let o=0;o<4;o++)s[o]=i[o]*(1-t)+n*e[o]*t;let r=Math.hypot(...s);return r>0?[s[0]/r,s[1]/r,s[2]/r,s[3]/r]:[1,0,0,0]}function Vm(i){let e=vd(i);if(e[0]<-.999999)return[0,0,0,1];let t=[1+e[0],0,-e[2],e[1]],n=Math.hypot(...t);return[t[0]/n,t[1]/n,t[2]/n,t[3]/n]}function Gm(i,e,t,n,s){let r=ls(n,t),o=ls(s,t),a=zm(e,o),l=Kc(r,a);if(l===0)return 1/0;let c=ls(i,t),h=Kc(c,a)/l;if(h<0||h>1)return 1/0;let u=zm(c,r),d=Kc(e,u)/l;if(d<0||h+d>1)return 1/0;let f=Kc(o,u)/l;return f>0?f:1/0}function Wm(i,e,t,n,s,r,o){let a=t-i[0],l=n-i[1],c=s-i[2],h=a*e[0]+l*e[1]+c*e[2];return h<-r||h-r>o?!1:a*a+l*l+c*c-h*h<=r*r}function Mo(i,e,t,n){let[s,r,o]=[e[0],e[1],e[2]],a=i[3]*s+i[7]*r+i[11]*o+i[15];if(a<=1e-9)return null;let l=(i[2]*s+i[6]*r+i[10]*o+i[14])/a;if(l<-1||l>1)return null;let c=(i[0]*s+i[4]*r+i[8]*o+i[12])/a,h=(i[1]*s+i[5]*r+i[9]*o+i[13])/a;return{x:(c*.5+.5)*t,y:(.5-h*.5)*n,depth:l}}function jc(i){let e=10**Math.floor(Math.log10(i)),t=i/e;return(t>=5?5:t>=2?2:1)*e}var Cs=128,Qc=class{constructor(e,t){this.count=e;let n=Math.max(1,Math.ceil(e/Cs)),s=()=>{let a=new Float32Array(Cs*n*4);for(let h=0;h<e;h++)a[h*4+3]=t[h]??.1;let l=new mi(a,Cs,n,yi,ti),c=new mi(new Int16Array(Cs*n*4),Cs,n,yo,xa);c.internalFormat="RGBA16I";for(let h of[l,c])h.needsUpdate=!0,h.unpackAlignment=8;return{frame:null,places:l,turns:c}};this.slots=[s(),s()],this.colours=new mi(new Uint8Array(Cs*n*4).fill(255),Cs,n),this.colours.needsUpdate=!0;let[r,o]=this.slots;this.uniforms={uPlacesA:{value:r.places},uPlacesB:{value:o.places},uTurnsA:{value:r.turns},uTurnsB:{value:o.turns},uColours:{value:this.colours},uF:{value:0}}}count;uniforms;colours;a=null;b=null;f=0;slots;show(e,t,n){let[s,r]=this.slots;s.frame!==e&&r.frame===e&&e!==t&&([s,r]=this.slots=[r,s]),s.frame!==e&&this.fill(s,e),r.frame!==t&&this.fill(r,t),this.uniforms.uPlacesA.value=s.places,this.uniforms.uPlacesB.value=r.places,this.uniforms.uTurnsA.value=s.turns,this.uniforms.uTurnsB.value=r.turns,this.uniforms.uF.value=n,this.a=e,this.b=t,this.f=n}time(){return this.a&&this.b?this.a.time+(this.b.time-this.a.time)*this.f:0}place(e){let{a:t,b:n,f:s}=this;if(!t||!n||e<0||e>=t.n||e>=n.n)return null;let r=a=>t.positions[3*e+a]*(1-s)+n.positions[3*e+a]*s,o=[r(0),r(1),r(2)];return o.every(Number.isFinite)?o:null}turn(e){let{a:t,b:n,f:s}=this;if(!t||!n||e>=t.n||e>=n.n)return[1,0,0,0];let r=o=>[0,1,2,3].map(a=>o.attitudes[4*e+a]/32767);return Hm(r(t),r(n),s)}dispose(){for(let e of this.slots)e.places.dispose(),e.turns.dispose();this.colours.dispose()}fill(e,t){let n=Math.min(t.n,this.count),s=e.places.image.data,r=t.positions;for(let o=0;o<n;o++)s[4*o]=r[3*o],s[4*o+1]=r[3*o+1],s[4*o+2]=r[3*o+2];e.turns.image.data.set(t.attitudes.subarray(0,4*n)),e.places.needsUpdate=!0,e.turns.needsUpdate=!0,e.frame=t}},La=`
precision highp int;
precision highp sampler2D;
precision highp isampler2D;
uniform sampler2D uPlacesA, uPlacesB, uColours;
uniform isampler2D uTurnsA, uTurnsB;
uniform float uF;
uniform mat4 uSee;
ivec2 cell(float i) { int n = int(i + 0.5); return ivec2(n % ${Cs}, n / ${Cs}); }
/** Place, and the radius. */
vec4 placeOf(float i) {
  ivec2 c = cell(i);
  return mix(texelFetch(uPlacesA, c, 0), texelFetch(uPlacesB, c, 0), uF);
}
vec4 turnOf(float i) {
  ivec2 c = cell(i);
  vec4 a = vec4(texelFetch(uTurnsA, c, 0)), b = vec4(texelFetch(uTurnsB, c, 0));
  vec4 q = mix(a, dot(a, b) < 0.0 ? -b : b, uF);
  float l = length(q);
  return l > 0.0 ? q / l : vec4(1.0, 0.0, 0.0, 0.0);
}
vec3 turned(vec4 q, vec3 v) {
  vec3 t = 2.0 * cross(q.yzw, v);
  return v + q.x * t + cross(q.yzw, t);
}
vec4 colourOf(float i) { return texelFetch(uColours, cell(i), 0); }
`;var tM=`
${La}
attribute vec3 from, to;
/** The numbers of the vehicles at both ends; below 0: the place \`from\`, \`to\`. */
attribute vec2 ends;
/** Fading lines: when each end was there, s. Pulses: the start and how long it takes, wall s. */
attribute vec2 times;
attribute vec4 colour;
uniform vec3 uViewport;
uniform float uWidth, uNow, uFade, uClock, uOpacity;
varying vec4 vColour;
varying float vSide;
void main() {
  vec3 a = ends.x < 0.0 ? from : placeOf(ends.x).xyz;
  vec3 b = ends.y < 0.0 ? to : placeOf(ends.y).xyz;
  float alpha = colour.a * uOpacity;
  float width = uWidth;
  #ifdef PULSE
  float u = (uClock - times.x) / times.y;
  vec3 d = b - a;
  float head = clamp(u * 1.25, 0.0, 1.0), tail = clamp(u * 1.25 - 0.25, 0.0, 1.0);
  if (u < 0.0 || u > 1.0) alpha = 0.0;
  b = a + d * head;
  a = a + d * tail;
  if (position.x < 0.5) alpha *= 0.05;
  #else
  if (uFade > 0.0) {
    float age = (uNow - (position.x < 0.5 ? times.x : times.y)) / uFade;
    alpha *= age < -0.001 || age > 1.0 ? 0.0 : (1.0 - age) * (1.0 - age * 0.4);
  }
  #endif
  vec4 ca = uSee * vec4(a, 1.0);
  vec4 cb = uSee * vec4(b, 1.0);
  // What is behind the eye is cut off at a plane just in front of it.
  float least = 1e-4 * max(max(ca.w, cb.w), 1e-3);
  if (ca.w < least && cb.w < least) alpha = 0.0;
  else if (ca.w < least) ca = mix(ca, cb, (least - ca.w) / (cb.w - ca.w));
  else if (cb.w < least) cb = mix(cb, ca, (least - cb.w) / (ca.w - cb.w));
  vec2 pa = ca.xy / ca.w * uViewport.xy, pb = cb.xy / cb.w * uViewport.xy;
  vec2 way = pb - pa;
  float l = length(way);
  way = l > 1e-4 ? way / l : vec2(1.0, 0.0);
  vec2 side = vec2(-way.y, way.x) * position.y * (width + 0.7) * uViewport.z;
  vec4 at = position.x < 0.5 ? ca : cb;
  at.xy += side / uViewport.xy * at.w;
  at.z -= 2e-5 * at.w;
  gl_Position = alpha < 0.004 ? vec4(2.0, 2.0, 2.0, 1.0) : at;
  vColour = vec4(colour.rgb, alpha);
  vSide = position.y * (width + 0.7);
}
`,nM=`
uniform float uWidth;
varying vec4 vColour;
varying float vSide;
void main() {
  float a = clamp(uWidth + 0.7 - abs(vSide), 0.0, 1.0);
  gl_FragColor = vec4(vColour.rgb, vColour.a * a);
}
`,ri=class{constructor(e,t,n,s){this.capacity=e;let r=new yr;r.setAttribute("position",new lt([0,-1,0,1,-1,0,1,1,0,0,1,0],3)),r.setIndex([0,1,2,0,2,3]);let o=l=>{let c=new Pi(new Float32Array(e*l),l);return c.setUsage(Gc),c};r.setAttribute("from",this.from=o(3)),r.setAttribute("to",this.to=o(3)),r.setAttribute("ends",this.ends=o(2)),r.setAttribute("times",this.times=o(2)),this.colour=new Pi(new Uint8Array(e*4),4,!0),this.colour.setUsage(Gc),r.setAttribute("colour",this.colour),r.instanceCount=0;let a=new Wt({vertexShader:tM,fragmentShader:nM,defines:s.pulse?{PULSE:1}:{},uniforms:{...n,...t.uniforms,uWidth:{value:s.width_px/2},uNow:{value:0},uFade:{value:s.fade_s??0},uOpacity:{value:1}},transparent:!0,depthWrite:!1,depthTest:!s.above,side:ln,blending:s.shine?va:ir});this.mesh=new Bt(r,a),this.mesh.frustumCulled=!1,this.mesh.renderOrder=s.order??10}capacity;mesh;from;to;ends;times;colour;next=0;used=0;get count(){return this.used}set(e,t){this.mesh.material.uniforms[e].value=t}clear(){this.next=0,this.used=0,this.mesh.geometry.instanceCount=0}add(e,t,n,s=0,r=0){let o=this.next;this.next=(this.next+1)%this.capacity,this.used=Math.min(this.used+1,this.capacity);let a=(l,c,h)=>{let u=this.ends.array;if(typeof h=="number")u[2*o+c]=h;else{u[2*o+c]=-1;for(let d=0;d<3;d++)l.array[3*o+d]=h[d]}};return a(this.from,0,e),a(this.to,1,t),this.times.array[2*o]=s,this.times.array[2*o+1]=r,this.recolour(o,n),o}recolour(e,t){for(let n=0;n<4;n++)this.colour.array[4*e+n]=t[n]}flush(e=0,t=this.capacity){for(let n of[this.from,this.to,this.ends,this.times,this.colour]){if(t<this.capacity){let s=e+t;n.addUpdateRange(e*n.itemSize,(Math.min(s,this.capacity)-e)*n.itemSize),s>this.capacity&&n.addUpdateRange(0,(s-this.capacity)*n.itemSize)}else n.clearUpdateRanges(),this.used<this.capacity&&n.addUpdateRange(0,Math.max(this.used,1)*n.itemSize);n.needsUpdate=!0}this.mesh.geometry.instanceCount=this.used}dispose(){this.mesh.geometry.dispose(),this.mesh.material.dispose()}};var eh=6e3,Xm=["#ff4d6d","#00b4d8","#ffb703","#9b5de5","#43aa8b","#f15bb5"];function iM(i,e){let{reading:t,columns:n}=i,s=Math.max(n.length,1),r=n.findIndex(([,o])=>o==="m");return!t||r<0||t.length!==e*s||i.lost?null:Array.from({length:e},(o,a)=>t[a*s+r]??null)}var th=class{constructor(e,t,n){this.frames=e;this.reach=n;this.lines=new ri(eh,e,t,{width_px:1.6,order:15});let s=new zt;s.setAttribute("position",new Nn(new Float32Array(eh*3),3)),s.setAttribute("colour",new Nn(new Uint8Array(eh*4),4,!0)),s.setDrawRange(0,0),this.dots=new la(s,new Wt({uniforms:{...t,uSize:{value:6}},vertexShader:`
          attribute vec4 colour;
          uniform vec3 uViewport;
          uniform mat4 uSee;
          uniform float uSize;
          varying vec3 vColour;
          void main() {
            vColour = colour.rgb;
            gl_Position = uSee * vec4(position, 1.0);
            gl_Position.z -= 4e-5 * gl_Position.w;
            gl_PointSize = uSize * uViewport.z;
          }`,fragmentShader:`
          varying vec3 vColour;
          void main() {
            float r = length(gl_PointCoord - 0.5);
            if (r > 0.5) discard;
            gl_FragColor = vec4(r > 0.36 ? vec3(1.0) : vColour, 1.0);
          }`,transparent:!0,depthWrite:!1})),this.dots.frustumCulled=!1,this.dots.renderOrder=16,this.volumes.matrixAutoUpdate=!1,this.group.add(this.lines.mesh,this.volumes,this.dots)}frames;reach;group=new Hn;lines;volumes=new Hn;dots;rays=[];vehicle=null;set(e){this.rays=[];for(let t of[...this.volumes.children])this.volumes.remove(t),(t instanceof Bt||t instanceof po)&&(t.geometry.dispose(),t.material.dispose());this.vehicle=e?.vehicle??null,e?.sensors.forEach((t,n)=>this.addSensor(t,Xm[n%Xm.length]))}update(){let e=this.vehicle===null?null:this.frames.place(this.vehicle);if(this.group.visible=e!==null,!e||this.vehicle===null)return;let t=this.frames.turn(this.vehicle);this.volumes.matrix.compose(new k(...e),new Vn(t[1],t[2],t[3],t[0]),new k(1,1,1)),this.volumes.updateMatrixWorld(!0),this.lines.clear();let n=this.dots.geometry,[s,r]=[n.getAttribute("position"),n.getAttribute("colour")],o=0,a=this.rays.length>60?90:220;for(let l of this.rays){let c=si(e,Jc(t,l.from)),h=si(c,bi(Jc(t,l.along),l.length));this.lines.add(c,h,[...l.colour,l.hit?a:a*.4]),l.hit&&(s.setXYZ(o,...h),r.array.set([...l.colour,255],4*o),o++)}this.lines.set("uWidth",this.rays.length>60?.5:1),this.lines.flush(),n.setDrawRange(0,o),s.needsUpdate=!0,r.needsUpdate=!0,this.dots.material.uniforms.uSize.value=this.rays.length>60?4:8}dispose(){this.set(null),this.lines.dispose(),this.dots.geometry.dispose(),this.dots.material.dispose()}addSensor(e,t){let{beams:n,mount:s}=e;if(!n)return;let r=new xt(t),o=[r.r*255,r.g*255,r.b*255],a=Math.min(n.range_m,this.reach());if(a>0)if("rays"in n){let l=iM(e,n.rays.length);n.rays.slice(0,eh-this.rays.length).forEach((c,h)=>{let u=Jc(s.turn,vd(c)),d=l?.[h]??null,f=d!==null&&d>=0&&d<n.range_m*.999;this.rays.push({from:s.at,along:u,length:f?d:a,hit:f,colour:o})})}else if("cone"in n){let l=Math.min(n.cone,Math.PI),c=new Ts(a,40,14,0,2*Math.PI,0,l).rotateZ(-Math.PI/2);this.addVolume(e,r,c,.1);let h=[];for(let u=0;u<40;u++){for(let d of[u,u+1])h.push(...qm(a,l,d*Math.PI/20));u%5===0&&h.push(0,0,0,...qm(a,l,u*Math.PI/20))}this.addEdges(e,r,h)}else if("frustum"in n){let[l,c]=n.frustum.map(m=>Math.tan(Math.min(m,3)/2)),h=(m,y)=>bi([1,m*l,y*c],a),[u,d,f,g]=[h(1,1),h(-1,1),h(-1,-1),h(1,-1)],v=[0,0,0],p=new zt;p.setAttribute("position",new lt([v,u,d,v,d,f,v,f,g,v,g,u,u,f,d,u,g,f].flat(),3)),this.addVolume(e,r,p,.09),this.addEdges(e,r,[v,u,v,d,v,f,v,g,u,d,d,f,f,g,g,u].flat())}else{this.addVolume(e,r,new Ts(a,40,24),.08);let l=[];for(let c=0;c<64;c++)for(let h of[c,c+1])l.push(a*Math.cos(h*Math.PI/32),a*Math.sin(h*Math.PI/32),0);this.addEdges(e,r,l)}}stand(e,t){let[n,s,r,o]=t.mount.turn;e.position.set(...t.mount.at),e.quaternion.set(s,r,o,n),this.volumes.add(e)}addVolume(e,t,n,s){let r=new uo({color:t,transparent:!0,opacity:s,depthWrite:!1,side:ln}),o=new Bt(n,r);o.renderOrder=22,this.stand(o,e)}addEdges(e,t,n){let s=new zt;s.setAttribute("position",new lt(n,3));let r=new po(s,new fo({color:t,transparent:!0,opacity:.8,depthWrite:!1}));r.renderOrder=23,this.stand(r,e)}};function qm(i,e,t){return[i*Math.cos(e),i*Math.sin(e)*Math.cos(t),i*Math.sin(e)*Math.sin(t)]}var Tr=Math.tan(40/2*(Math.PI/180)),sM=2e-4,_d=.02,xd=2e5,rM={top:[-Math.PI/2,Math.PI/2],north:[Math.PI/2,0],east:[0,0],south:[-Math.PI/2,0],west:[Math.PI,0]},nh=class{camera=new xr;now={target:[0,0,0],azimuth:-1.05,elevation:.36,zoom:Math.log(30),flat:0};goal=structuredClone(this.now);lastOrbit=[this.now.azimuth,this.now.elevation];anchor=null;lastAnchor=[0,0,0];seconds=.07;aspect=1;height=1;reach=100;retreat=0;resize(e,t){this.aspect=e/Math.max(t,1),this.height=Math.max(t,1)}target(){return si(this.now.target,this.base())}distance(){return Math.exp(this.now.zoom)}pixel(){return 2*this.distance()*Tr/this.height}isFlat(){return this.goal.flat===1}following(){return this.anchor!==null}axes(e=this.now){let[t,n]=[Math.sin(e.azimuth),Math.cos(e.azimuth)],[s,r]=[Math.sin(e.elevation),Math.cos(e.elevation)];return[[r*n,r*t,s],[-t,n,0],[-s*n,-s*t,r]]}step(e){let t=1-Math.exp(-Math.min(e,.4)/this.seconds),{now:n,goal:s}=this,r=ls(s.target,n.target);return Math.max(Math.hypot(...r)/this.distance(),Math.abs(s.azimuth-n.azimuth),Math.abs(s.elevation-n.elevation),Math.abs(s.zoom-n.zoom),Math.abs(s.flat-n.flat)*.1)<sM?(this.now=structuredClone(s),this.seconds=.07,!1):(n.target=si(n.target,bi(r,t)),n.azimuth+=(s.azimuth-n.azimuth)*t,n.elevation+=(s.elevation-n.elevation)*t,n.zoom+=(s.zoom-n.zoom)*t,n.flat+=(s.flat-n.flat)*t,!0)}apply(){let[e,t,n]=this.axes(),s=this.distance(),r=this.target(),o=s*Tr,a=Math.max(this.reach,s*4)+Math.hypot(...r),l=this.camera.projectionMatrix,c=this.now.flat>.985,h=c?a:s/(1-this.now.flat);this.retreat=c?0:h-s;let u=si(r,bi(e,h));if(c){let d=o*this.aspect;l.makeOrthographic(-d,d,o,-o,0,2*a)}else{let d=s*.01+(h-s)*.2,f=o/h*d;l.makePerspective(-f*this.aspect,f*this.aspect,f,-f,d,h+2*a)}this.camera.projectionMatrixInverse.copy(l).invert(),this.camera.matrixAutoUpdate=!1,this.camera.matrix.makeBasis(new k(...t),new k(...n),new k(...e)),this.camera.matrix.setPosition(...u),this.camera.position.set(...u),this.camera.updateMatrixWorld(!0),this.camera.matrixWorldInverse.copy(this.camera.matrixWorld).invert()}lens(){return{tan:Tr*(1-this.now.flat),aspect:this.aspect,flat:this.now.flat>.985}}ray(e,t){let n=new it().multiplyMatrices(this.camera.matrixWorld,this.camera.projectionMatrixInverse),s=new k(e,t,-1).applyMatrix4(n),r=new k(e,t,.5).applyMatrix4(n).sub(s).normalize();return{from:[s.x,s.y,s.z],along:[r.x,r.y,r.z]}}orbit(e,t){this.hurry(),this.goal.flat=0,this.goal.azimuth-=e*.006,this.goal.elevation=ii(this.goal.elevation+t*.006,-1.5,Math.PI/2),this.lastOrbit=[this.goal.azimuth,this.goal.elevation]}pan(e,t){this.hurry();let n=2*Math.exp(this.goal.zoom)*Tr/this.height,[,s,r]=this.axes(this.goal);this.goal.target=si(this.goal.target,si(bi(s,-e*n),bi(r,t*n)))}zoomBy(e,t,n){this.hurry();let s=Math.exp(this.goal.zoom),r=ii(s*e,_d,xd);if(this.goal.zoom=Math.log(r),this.anchor)return;let[,o,a]=this.axes(this.goal),l=(s-r)*Tr;this.goal.target=si(this.goal.target,si(bi(o,t*l*this.aspect),bi(a,n*l)))}lookAt(e){this.seconds=.12,this.goal.target=ls(e,this.base())}setView(e){this.seconds=.11;let[t,n]=e==="orbit"?this.lastOrbit:rM[e],s=Math.round((this.now.azimuth-t)/(2*Math.PI));this.goal.azimuth=t+s*2*Math.PI,this.goal.elevation=n,this.goal.flat=e==="orbit"?0:1}fit(e,t,n){let s=this.axes(this.goal),r=[1/0,1/0,1/0],o=[-1/0,-1/0,-1/0],a=[];for(let d of e){let f=s.map(g=>g[0]*d[0]+g[1]*d[1]+g[2]*d[2]);if(f.every(Number.isFinite)){a.push(f);for(let g=0;g<3;g++)r[g]=Math.min(r[g],f[g]),o[g]=Math.max(o[g],f[g])}}if(a.length===0)return;let l=[0,1,2].map(d=>(r[d]+o[d])/2),c=0,h=Tr*Math.min(this.aspect,3);for(let d of a){let f=this.goal.flat===1?0:d[0]-l[0],g=f+(Math.abs(d[1]-l[1])+t)/h,v=f+(Math.abs(d[2]-l[2])+t)/Tr;c=Math.max(c,g,v)}let u=s.reduce((d,f,g)=>si(d,bi(f,l[g])),[0,0,0]);this.seconds=.12,this.goal.target=ls(u,this.base()),this.goal.zoom=Math.log(ii(c*1.12,_d*5,xd)),n&&(this.now=structuredClone(this.goal))}follow(e){let t=this.target(),n=si(this.goal.target,this.base());this.anchor=e;let s=this.base();this.now.target=ls(t,s),this.goal.target=e?[0,0,0]:n,this.seconds=.12}set(e){let t=ls(e.from,e.at),n=ii(Math.hypot(...t),_d,xd);if(![...e.from,...e.at].every(Number.isFinite))return;let s=Math.asin(ii(t[2]/n,-1,1)),r=Math.hypot(t[0],t[1])<1e-6*n?-Math.PI/2:Math.atan2(t[1],t[0]),o=e.flat?1:0;this.goal={target:ls(e.at,this.base()),azimuth:r,elevation:s,zoom:Math.log(n),flat:o},o||(this.lastOrbit=[r,s]),this.now=structuredClone(this.goal)}state(){let e=this.target(),t=si(e,bi(this.axes()[0],this.distance())),n=s=>s.map(r=>Math.round(r*1e4)/1e4);return{from:n(t),at:n(e),flat:this.isFlat()}}base(){if(!this.anchor)return[0,0,0];let e=this.anchor();return e&&(this.lastAnchor=e),this.lastAnchor}hurry(){this.seconds=.045}};var rr=[148,148,148],yd=["#ffb000","#3da5ff","#ff5c4d","#00c2a0","#e06bd0","#fff27a","#8f7bff","#ff9ec0","#a3e635","#c8c8d0"],oM=["#440154","#472d7b","#3b528b","#2c728e","#21918c","#28ae80","#5ec962","#addc30","#fde725"],aM=["#3b0f9b","#6a00a8","#900da4","#b12a90","#cc4778","#e16462","#f2844b","#fca636","#fcce25","#f0f921"],lM=["#c1121f","#e8590c","#f9a03f","#fde2a0","#a8d5e5","#5fa8d3","#1d6fb8"],cM=["#b3123f","#d9480f","#8f3fbf","#2f49d1","#0b2bd0"],hM=["#ff5d73","#ff9d5c","#ffe08a","#8fe3ff","#e6fbff"],cs={value:oM,speed:aM,battery:lM,signal:cM,signalDark:hM};function uM(i){if(!/^#([0-9a-f]{6}|[0-9a-f]{8})$/i.test(i))return null;let e=t=>parseInt(i.slice(t,t+2),16);return[e(1),e(3),e(5),i.length===9?e(7):255]}function Ps(i){return uM(i)??[rr[0],rr[1],rr[2],255]}function ih(i,e){if(!Number.isFinite(e))return rr;let t=ii(e,0,1)*(i.length-1),n=Math.min(Math.floor(t),i.length-2),s=Ps(i[n]),r=Ps(i[n+1]),o=t-n;return[0,1,2].map(a=>Math.round(s[a]+(r[a]-s[a])*o))}function sh(i){let e=new Uint8Array(768);for(let t=0;t<256;t++)e.set(ih(i,t/255),t*3);return e}function Ym(i){let e=Math.max(1,Math.floor(i.length/4e3)),t=[];for(let l=0;l<i.length;l+=e)Number.isFinite(i[l])&&t.push(i[l]);if(t.length===0)return null;t.sort((l,c)=>l-c);let n=t.length-1,s=t[Math.floor(.02*n)],r=t[Math.ceil(.98*n)];if(!(r>s)){let l=Math.max(Math.abs(s)*.05,1e-9);s-=l,r+=l}let o=jc((r-s)/4),a=l=>Number(l.toPrecision(12));return[a(Math.floor(s/o+1e-9)*o),a(Math.ceil(r/o-1e-9)*o)]}function $m(i,e){if(!e)return i;if(!i)return e;let t=(e[1]-e[0])/(i[1]-i[0]);return e[0]>=i[0]&&e[1]<=i[1]&&t>=.5?i:e[1]<i[0]||e[0]>i[1]||t<.5?e:[Math.min(i[0],e[0]),Math.max(i[1],e[1])]}function wo(i){return(i/255)**2}function Zm(i){return"#"+i.slice(0,3).map(e=>ii(Math.round(e),0,255).toString(16).padStart(2,"0")).join("")}function rh(i,e=1){let t=n=>wo(parseInt(i.slice(n,n+2),16))*e;return new k(t(1),t(3),t(5))}function Km(i){let e=new mi(new Uint8Array([255,255,255,255]),1,1);e.needsUpdate=!0;let t={uSun:{value:new k(-.52,-.36,.77).normalize()},uSunLight:{value:new k},uSkyLight:{value:new k},uEarthLight:{value:new k},uHaze:{value:new k},uZenith:{value:new k},uHazeRange:{value:new vt(1e4,2e4)},uViewport:{value:new k(1,1,1)},uWorldTone:{value:1},uSee:{value:new it},uClock:{value:0},uShadow:{value:e},uShadowFrom:{value:new it},uShadowDepth:{value:0},uShadowFine:{value:1}};return bd(t,i),t}function bd(i,e){e?(i.uSunLight.value.set(.62,.7,.95).multiplyScalar(.5),i.uSkyLight.value.set(.42,.52,.78).multiplyScalar(.5),i.uEarthLight.value.set(.2,.22,.27).multiplyScalar(.5),i.uHaze.value.copy(rh("#1a2433")),i.uZenith.value.copy(rh("#070b14")),i.uWorldTone.value=.62):(i.uSunLight.value.set(.86,.8,.69),i.uSkyLight.value.set(.46,.52,.6),i.uEarthLight.value.set(.25,.24,.22),i.uHaze.value.copy(rh("#dfe8ee")),i.uZenith.value.copy(rh("#8fb8de")),i.uWorldTone.value=1)}var Is=`
uniform vec3 uSun, uSunLight, uSkyLight, uEarthLight, uHaze;
uniform vec2 uHazeRange;
vec3 fromSrgb(vec3 c) { return c * c; }
vec3 toSrgb(vec3 c) { return sqrt(min(c, 1.0)); }
/** A matt surface in the sun and under the sky. */
vec3 lit(vec3 colour, vec3 n, float sun) {
  vec3 sky = mix(uEarthLight, uSkyLight, n.z * 0.5 + 0.5);
  return colour * (sky + uSunLight * (max(dot(n, uSun), 0.0) * sun));
}
vec3 hazed(vec3 colour, float away) {
  float h = smoothstep(uHazeRange.x, uHazeRange.y, away);
  return mix(colour, uHaze, h);
}
`,oh=`
uniform sampler2D uShadow;
uniform mat4 uShadowFrom;
uniform float uShadowDepth, uShadowFine;
float sunAt(vec3 world) {
  if (uShadowDepth <= 0.0) return 1.0;
  vec3 s = (uShadowFrom * vec4(world, 1.0)).xyz * 0.5 + 0.5;
  if (any(lessThan(s, vec3(0.002))) || any(greaterThan(s, vec3(0.998)))) return 1.0;
  vec2 texel = 1.0 / vec2(textureSize(uShadow, 0));
  vec2 at = s.xy / texel - 0.5;
  vec2 f = fract(at);
  vec2 c = (floor(at) + 0.5) * texel;
  float z = s.z - uShadowDepth;
  if (uShadowFine < 0.5) return step(z, texture2D(uShadow, s.xy).r);
  float a = step(z, texture2D(uShadow, c).r);
  float b = step(z, texture2D(uShadow, c + vec2(texel.x, 0.0)).r);
  float d = step(z, texture2D(uShadow, c + vec2(0.0, texel.y)).r);
  float e = step(z, texture2D(uShadow, c + texel).r);
  return mix(mix(a, b, f.x), mix(d, e, f.x), f.y);
}
`;var dM=`
uniform vec3 uCentre;
uniform mat4 uSee;
varying vec2 vAt;
varying float vAway;
void main() {
  vec3 world = vec3(position.xy * uCentre.z + uCentre.xy, 0.0);
  vAt = world.xy;
  gl_Position = uSee * vec4(world, 1.0);
  vAway = isOrthographic ? 0.0 : gl_Position.w;
}
`,fM=`
${Is}
${oh}
uniform vec3 uColour, uLine;
uniform float uWorldTone, uGrid, uGridFade, uWorldRadius, uShowGrid;
uniform sampler2D uNoise;
uniform vec3 uViewport;
varying vec2 vAt;
varying float vAway;
/** How much of a line of a grid so wide covers this pixel, which is \`w\` wide. */
float lines(vec2 w, float spacing, float px) {
  vec2 p = vAt / spacing;
  vec2 d = abs(fract(p - 0.5) - 0.5) * spacing / w;
  vec2 l = clamp(px + 0.5 - d, 0.0, 1.0) * clamp(1.4 - w / spacing * 3.5, 0.0, 1.0);
  return max(l.x, l.y);
}
void main() {
  vec3 base = uColour * (uWorldTone * (0.88 + 0.24 * texture2D(uNoise, vAt / 61.0).r));
  vec2 w = max(fwidth(vAt), 1e-9) * uViewport.z;
  float r = length(vAt);
  // Beyond the edge of the world the ground pales.
  bool beyond = r > uWorldRadius;
  if (beyond) base = mix(base, vec3(dot(base, vec3(0.3, 0.6, 0.1)) * 0.75), 0.6);
  vec3 colour = lit(base, vec3(0.0, 0.0, 1.0), sunAt(vec3(vAt, 0.0)));
  if (uShowGrid > 0.0) {
    float fine = lines(w, uGrid, 0.5) * uGridFade * 0.18;
    float middle = lines(w, uGrid * 10.0, 0.6) * mix(0.22, 0.36, uGridFade);
    float wide = lines(w, uGrid * 100.0, 0.9) * 0.42;
    float line = max(max(fine, middle), wide);
    colour = mix(colour, uLine, beyond ? line * 0.4 : line);
    vec2 axis = clamp(1.4 - abs(vAt.yx) / w.yx, 0.0, 1.0) * 0.55;
    colour = mix(colour, vec3(0.75, 0.16, 0.1), axis.x);
    colour = mix(colour, vec3(0.1, 0.42, 0.16), axis.y);
  }
  float edge = clamp(1.6 - abs(r - uWorldRadius) / max(w.x, w.y), 0.0, 1.0);
  colour = mix(colour, uLine, edge * 0.6);
  gl_FragColor = vec4(toSrgb(hazed(colour, vAway)), 1.0);
}
`,pM=`
varying vec2 vScreen;
void main() { vScreen = position.xy; gl_Position = vec4(position.xy, 0.999999, 1.0); }
`,mM=`
${Is}
uniform vec3 uZenith, uBack, uRight, uUp, uColour;
uniform float uWorldTone, uTargetHeight, uHalfHeight, uPlane;
uniform vec2 uTan;
varying vec2 vScreen;
void main() {
  vec3 colour;
  if (isOrthographic) {
    // From the side there is no horizon but the ground, cut through.
    float z = uTargetHeight + vScreen.y * uHalfHeight;
    float side = 1.0 - smoothstep(0.02, 0.1, abs(uBack.z));
    colour = mix(uHaze, uZenith, 0.35 * clamp(vScreen.y * 0.5 + 0.5, 0.0, 1.0));
    if (z < 0.0 && uPlane > 0.0) colour = mix(colour, uColour * uWorldTone * 0.5, side);
  } else {
    vec3 d = normalize(-uBack + uRight * vScreen.x * uTan.x + uUp * vScreen.y * uTan.y);
    float h = clamp(d.z, 0.0, 1.0);
    float g = 1.0 - h;
    colour = mix(uZenith, uHaze, g * g * g);
    float s = max(dot(d, uSun), 0.0);
    s *= s;
    s *= s;
    colour += uSunLight * (0.16 * s * s);
  }
  gl_FragColor = vec4(toSrgb(colour), 1.0);
}
`;function gM(){let e=new Uint8Array(16384),t=12345,n=()=>(t=Math.imul(t,1664525)+1013904223>>>0)/2**32,s=a=>{let l=Array.from({length:a*a},n),c=h=>h*h*(3-2*h);return(h,u)=>{let[d,f]=[h/64*a,u/64*a],[g,v]=[Math.floor(d),Math.floor(f)],p=(R,b)=>l[(R+a)%a+(b+a)%a*a],[m,y]=[c(d-g),c(f-v)];return(p(g,v)*(1-m)+p(g+1,v)*m)*(1-y)+(p(g,v+1)*(1-m)+p(g+1,v+1)*m)*y}},r=[s(5),s(11),s(29)];for(let a=0;a<64;a++)for(let l=0;l<64;l++){let c=r[0](l,a)*.5+r[1](l,a)*.3+r[2](l,a)*.2;e.fill(Math.round(c*255),(a*64+l)*4,(a*64+l)*4+4)}let o=new mi(e,64,64);return o.wrapS=o.wrapT=Ks,o.magFilter=Fn,o.minFilter=vi,o.generateMipmaps=!0,o.needsUpdate=!0,o}var ah=class{group=new Hn;uniforms;noise=gM();ground;constructor(e,t,n,s){let[r,o,a]=Ps(e);this.uniforms={...s,uColour:{value:new k(wo(r),wo(o),wo(a))},uLine:{value:new k},uGrid:{value:1},uGridFade:{value:0},uShowGrid:{value:1},uWorldRadius:{value:n},uNoise:{value:this.noise},uCentre:{value:new k},uBack:{value:new k},uRight:{value:new k},uUp:{value:new k},uTan:{value:new vt},uTargetHeight:{value:0},uHalfHeight:{value:1},uPlane:{value:t?1:0}};let l=new Qs(2,2,8,8);this.ground=new Bt(l,new Wt({vertexShader:dM,fragmentShader:fM,uniforms:this.uniforms,side:ln,polygonOffset:!0,polygonOffsetFactor:1,polygonOffsetUnits:8})),this.ground.frustumCulled=!1,this.ground.visible=t,this.ground.renderOrder=1;let c=new Bt(new Qs(2,2),new Wt({vertexShader:pM,fragmentShader:mM,uniforms:this.uniforms,depthWrite:!1}));c.frustumCulled=!1,c.renderOrder=4,this.group.add(c,this.ground)}setDark(e){this.uniforms.uLine.value.setScalar(e?.3:.02)}showGrid(e){this.uniforms.uShowGrid.value=e?1:0}update(e,t){let[n,s,r]=e.axes(),o=this.uniforms;o.uBack.value.set(...n),o.uRight.value.set(...s),o.uUp.value.set(...r);let a=e.lens();o.uTan.value.set(a.tan*a.aspect,a.tan);let l=e.target();o.uTargetHeight.value=l[2],o.uHalfHeight.value=e.pixel()*o.uViewport.value.y/o.uViewport.value.z/2,o.uCentre.value.set(l[0],l[1],t);let c=Math.log10(e.pixel()*11),h=Math.ceil(c);return o.uGrid.value=10**h,o.uGridFade.value=Math.min(1,(h-c)*1.6),10**h}dispose(){this.noise.dispose(),this.group.traverse(e=>{e instanceof Bt&&(e.geometry.dispose(),e.material.dispose())})}};var vM=60,Sd='12px system-ui, -apple-system, "Segoe UI", "Liberation Sans", sans-serif',lh=class{canvas=document.createElement("canvas");c;widths=new Map;ratio=1;dark=!1;constructor(){this.c=this.canvas.getContext("2d"),Object.assign(this.canvas.style,{position:"absolute",inset:"0",width:"100%",height:"100%",pointerEvents:"none"})}resize(e,t,n){this.ratio=n,this.canvas.width=Math.max(1,Math.round(e*n)),this.canvas.height=Math.max(1,Math.round(t*n))}draw(e){let t=this.c;if(!t)return;t.setTransform(this.ratio,0,0,this.ratio,0,0),t.clearRect(0,0,e.width,e.height),t.font=Sd,t.textBaseline="middle",t.lineJoin="round";let n=[];e.selected!==null&&this.marker(t,e,e.selected,n),e.labels&&this.labels(t,e,n),e.grid&&this.scale(t,e)}ink(){return this.dark?"#f2f5f9":"#10161d"}paper(e){return this.dark?`rgb(8 12 18 / ${e})`:`rgb(255 255 255 / ${e})`}text(e,t,n,s){e.strokeStyle=this.paper(.85),e.lineWidth=3.5,e.strokeText(t,n,s),e.fillStyle=this.ink(),e.fillText(t,n,s)}wide(e,t){let n=this.widths.get(t);return n===void 0&&(this.widths.size>2e4&&this.widths.clear(),this.widths.set(t,n=e.measureText(t).width)),n}marker(e,t,n,s){let r=t.frames.place(n),o=r&&Mo(t.view,r,t.width,t.height);if(!r||!o)return;let a=Jm(t.view,r),l=Math.max(12,Math.min(t.radius_px(n,a)*1.3+5,160));for(let[f,g]of[[5,this.paper(.75)],[2.2,this.dark?"#ffd54a":"#d6006c"]])e.lineWidth=f,e.strokeStyle=g,e.beginPath(),e.arc(o.x,o.y,l,0,2*Math.PI),e.stroke();let c=t.names[n]??"",h=o.y-l-11,u=this.wide(e,c)/2;e.font="600 "+Sd,e.textAlign="center",this.text(e,c,o.x,h),e.font=Sd,e.textAlign="left",s.push([o.x-u-6,h-10,o.x+u+6,h+10]);let d=Mo(t.view,[r[0],r[1],0],t.width,t.height);if(d&&r[2]>0&&Math.hypot(d.x-o.x,d.y-o.y)>46){let f=jm(r[2]),[g,v]=[(o.x+d.x)/2+6,(o.y+d.y)/2];this.text(e,f,g,v),s.push([g,v-9,g+this.wide(e,f),v+9])}}labels(e,t,n){let{frames:s,width:r,height:o,view:a}=t,l=[];for(let h=0;h<s.count;h++){if(h===t.selected)continue;let u=s.place(h),d=u&&Mo(a,u,r,o);!u||!d||d.x<0||d.y<0||d.x>r||d.y>o||l.push({i:h,x:d.x,y:d.y,w:Jm(a,u)})}l.sort((h,u)=>Math.abs(h.w-u.w)>1e-9?h.w-u.w:h.i-u.i);let c=0;for(let{i:h,x:u,y:d,w:f}of l){if(c>=vM)break;let g=t.names[h]??"",v=u+Math.max(6,t.radius_px(h,f))+4,p=[v-2,d-8,v+this.wide(e,g)+2,d+8];n.some(m=>p[0]<m[2]&&p[2]>m[0]&&p[1]<m[3]&&p[3]>m[1])||(n.push(p),this.text(e,g,v,d),c++)}}scale(e,t){let n=jc(t.pixel_m*130),s=n/t.pixel_m,[r,o]=[16,t.height-18];for(let[a,l]of[[4.5,this.paper(.8)],[2,this.ink()]])e.strokeStyle=l,e.lineWidth=a,e.beginPath(),e.moveTo(r,o-5),e.lineTo(r,o),e.lineTo(r+s,o),e.lineTo(r+s,o-5),e.stroke();this.text(e,jm(n),r+5,o-11),this.compass(e,t)}compass(e,t){let[n,s,r]=[t.width-44,t.height-44,24],o=t.view,a=Math.hypot(o[0],o[4],o[8]),l=Math.hypot(o[1],o[5],o[9]),c=[["E","#e5484d",0],["N","#2fa84f",4],["up",this.dark?"#74a9ff":"#2463d6",8]];e.textAlign="center";for(let[h,u,d]of c){let[f,g]=[o[d]/a*r,-o[d+1]/l*r];if(Math.hypot(f,g)<4)continue;for(let[p,m]of[[5,this.paper(.7)],[2.5,u]])e.strokeStyle=m,e.lineWidth=p,e.beginPath(),e.moveTo(n,s),e.lineTo(n+f,s+g),e.stroke();let v=(r+10)/r;this.text(e,h,n+f*v,s+g*v)}e.textAlign="left"}};function Jm(i,e){return i[3]*e[0]+i[7]*e[1]+i[11]*e[2]+i[15]}function jm(i){let e=Math.abs(i),t=n=>String(Number(n.toPrecision(3)));return e>=1e3?`${t(i/1e3)} km`:e>=1?`${t(i)} m`:e>=.01?`${t(i*100)} cm`:`${t(i*1e3)} mm`}var ch=class{constructor(e,t,n){this.count=t;this.onLegend=n;this.bytes=new Uint8Array(t*4).fill(255),this.speeds=new Float32Array(t),this.kinds=_M(e)}count;onLegend;bytes;by="kind";title="";unit="";range=null;tables={value:sh(cs.value),speed:sh(cs.speed),battery:sh(cs.battery)};speeds;told="";kinds;set(e,t,n){this.by=e,this.title=t,this.unit=n,this.range=null}colour(e){return[this.bytes[4*e],this.bytes[4*e+1],this.bytes[4*e+2]]}update(e){if(this.by==="kind"||!e){this.kinds.colours.forEach((c,h)=>this.bytes.set(c,4*h)),this.tell({title:this.by==="kind"?this.title||"kind":this.title,unit:"",low:0,high:0,stops:[],names:this.kinds.names});return}let t=this.by==="speed"?this.speedsOf(e):e.values;this.by==="battery"?this.range=[0,1]:this.range=$m(this.range,t&&Ym(t));let[n,s]=this.range??[0,1],r=this.tables[this.by],o=Math.min(e.n,this.count),a=this.bytes,l=s>n?255/(s-n):0;for(let c=0;c<o;c++){let u=((t?t[c]:NaN)-n)*l;if(u>=0||u<0){let d=3*(u<0?0:u>255?255:u|0);a[4*c]=r[d],a[4*c+1]=r[d+1],a[4*c+2]=r[d+2]}else a[4*c]=rr[0],a[4*c+1]=rr[1],a[4*c+2]=rr[2]}this.tell({title:this.title||this.by,unit:this.unit||(this.by==="speed"?"m/s":""),low:n,high:s,stops:[...cs[this.by]]})}speedsOf(e){let t=e.velocities;if(!t)return null;let n=Math.min(e.n,this.count);for(let s=0;s<n;s++)this.speeds[s]=Math.hypot(t[3*s],t[3*s+1],t[3*s+2]);return this.speeds}tell(e){let t=JSON.stringify(e);t!==this.told&&(this.told=t,this.onLegend(e))}};function _M(i){let{kinds:e,colors:t}=i.vehicles,n=new Set(t),s=[...new Set(e)],r=n.size>1||s.length<=1,o=new Map(s.map((c,h)=>[c,yd[h%yd.length]])),a=[],l=new Map;return e.forEach((c,h)=>{let u=r?Zm(Ps(t[h]??"")):o.get(c),[d,f,g]=Ps(u);a.push([d,f,g]);let v=`${c} ${u}`;!l.has(v)&&l.size<12&&l.set(v,[c,u])}),{colours:a,names:[...l.values()]}}var hh=class{constructor(e,t,n,s){this.soft=t;this.setRatio=n;this.redraw=s;this.gl=e.getContext(),this.ratio=this.moving=t?1:this.finest()}soft;setRatio;redraw;ratio;drawn=0;ms=0;moving;began=0;recent=[];rest=0;poll=0;fence=null;gl;begin(e){this.began=performance.now(),clearTimeout(this.rest),this.use(e?this.finest():this.moving)}end(){this.drawn++,this.fence===null&&(this.fence=this.gl.fenceSync(this.gl.SYNC_GPU_COMMANDS_COMPLETE,0),this.gl.flush(),this.wait(this.began,this.ratio===this.moving)),this.ratio<this.finest()&&(this.rest=window.setTimeout(()=>{this.ms*(this.finest()/this.ratio)**2<900&&this.redraw()},350))}dispose(){clearTimeout(this.rest),clearTimeout(this.poll),this.fence&&this.gl.deleteSync(this.fence)}wait(e,t){this.poll=window.setTimeout(()=>{if(!this.fence)return;if(!(this.gl.isContextLost()||this.gl.getSyncParameter(this.fence,this.gl.SYNC_STATUS)===this.gl.SIGNALED))return this.wait(e,t);this.gl.deleteSync(this.fence),this.fence=null,t&&this.drawn>3&&this.note(performance.now()-e)},3)}finest(){return this.soft?2:Math.min(devicePixelRatio||1,2)}finestMoving(){return this.soft?1:this.finest()}use(e){e!==this.ratio&&(this.ratio=e,this.setRatio(e))}note(e){if(this.recent.push(e),this.recent.length>8&&this.recent.shift(),this.ms=this.recent.reduce((n,s)=>n+s,0)/this.recent.length,this.recent.length<5)return;let t=this.finestMoving();this.ms>50&&this.moving>.5?(this.moving=Math.max(.5,this.moving*.8),this.recent=[]):this.ms<18&&this.moving<t&&(this.moving=Math.min(t,this.moving*1.1),this.recent=[])}};var Qm=12;function eg(i,e,t,n,s,r,o,a){let l=null,c=1/0;for(let h=0;h<i;h++){let u=e(h);if(!u)continue;let d=Mo(t,u,n,s);if(!d)continue;let f=Math.hypot(d.x-r,d.y-o);if(f>Qm+60)continue;let g=t[3]*u[0]+t[7]*u[1]+t[11]*u[2]+t[15],v=Math.max(0,f-Math.max(0,a(h,g)));if(v>Qm)continue;let p=v+.001*f+.001*d.depth;p<c&&(c=p,l=h)}return l}function Md(i,e,t){let n=null,s=1/0;for(let r of i.targets){let[o,a,l,c]=r.ball;if(!Wm(e,t,o,a,l,c,s))continue;let h=xM(r,e,t);h<s&&(s=h,n=r)}return n?{target:n,away_m:s}:null}function xM(i,e,t){let n=i.matrix.clone().invert(),s=new k(...e).applyMatrix4(n),r=new k(...t).applyMatrix3(new qe().setFromMatrix4(n)),o=i.triangles(),[a,l]=[[s.x,s.y,s.z],[r.x,r.y,r.z]],c=u=>[o[u],o[u+1],o[u+2]],h=1/0;for(let u=0;u+8<o.length;u+=9)h=Math.min(h,Gm(a,l,c(u),c(u+3),c(u+6)));return h}function tg(i,e,t){let n=new Map,s=0,r=new AbortController,o={signal:r.signal},a=h=>{let u=i.getBoundingClientRect();return{x:h.clientX-u.left,y:h.clientY-u.top}},l=(h,u)=>[2*h/Math.max(i.clientWidth,1)-1,1-2*u/Math.max(i.clientHeight,1)];i.addEventListener("pointerdown",h=>{n.size===0&&(s=0),n.set(h.pointerId,{...a(h),button:h.button});try{i.setPointerCapture(h.pointerId)}catch{}t.hover(null)},o),i.addEventListener("pointermove",h=>{let u=a(h),d=n.get(h.pointerId);if(!d){h.pointerType!=="touch"&&t.hover(u);return}let[f,g]=[u.x-d.x,u.y-d.y];if(s+=Math.hypot(f,g),n.size===1){if(s<5)return;(d.button!==0||h.shiftKey)!==e.isFlat()?e.pan(f,g):e.orbit(f,g)}else if(n.size===2){let v=[...n].find(([y])=>y!==h.pointerId)[1],p=Math.hypot(d.x-v.x,d.y-v.y),m=Math.hypot(u.x-v.x,u.y-v.y);e.pan(f/2,g/2),p>1&&m>1&&e.zoomBy(p/m,...l((u.x+v.x)/2,(u.y+v.y)/2))}d.x=u.x,d.y=u.y,t.moved()},o);let c=h=>{let u=n.get(h.pointerId);if(n.delete(h.pointerId),h.type==="pointerup"&&u&&u.button===0&&n.size===0&&s<5){let{x:d,y:f}=a(h);t.click(d,f)}};return i.addEventListener("pointerup",c,o),i.addEventListener("pointercancel",c,o),i.addEventListener("pointerleave",()=>t.hover(null),o),i.addEventListener("dblclick",h=>{let{x:u,y:d}=a(h);t.doubleClick(u,d)},o),i.addEventListener("contextmenu",h=>h.preventDefault(),o),i.addEventListener("wheel",h=>{h.preventDefault();let u=h.deltaMode===1?16:h.deltaMode===2?400:1,d=h.ctrlKey?.01:.0015,{x:f,y:g}=a(h),v=Math.max(-300,Math.min(300,h.deltaY*u));e.zoomBy(Math.exp(v*d),...l(f,g)),t.moved()},{signal:r.signal,passive:!1}),i.style.touchAction="none",()=>r.abort()}var ng=-95,yM=-45,wd=12e3,ig=.35,sg=1,bM=4096,SM=40,MM=700;function rg(i){return Number.isFinite(i)?ii((i-ng)/(yM-ng),0,1):.5}var uh=class{links;pulses;until=0;dark=!1;last=[[],0];constructor(e,t){this.links=new ri(wd,e,t,{width_px:1.5,order:12}),this.pulses=new ri(bM,e,t,{width_px:4,pulse:!0,order:14})}setDark(e){this.dark=e,this.setLinks(...this.last)}setLinks(e,t){this.last=[e,t];let n=this.dark?cs.signalDark:cs.signal;this.links.clear();let s=e.filter(([a,l])=>a<t&&l<t&&a>=0&&l>=0),r=s.length>wd?[...s].sort((a,l)=>l[2]-a[2]).slice(0,wd):s,o=ii(1.2-.15*Math.log10(Math.max(r.length,1)),.3,1);for(let[a,l,c,h]of r){let u=rg(c),d=(.16+.84*u)*(.35+.65*ii(h,0,1))*o;this.links.add(a,l,[...ih(n,u),Math.round(255*d)])}this.links.set("uWidth",r.length<200?1:.65),this.links.flush()}addPackets(e,t,n,s){let r=s>0?ii(ig/s,ig,sg):sg,o=MM,a=Math.max(1,Math.min(SM,Math.floor(o/Math.max(e.length,1)))),l=-1,c=0;for(let h of e){if(h.from>=t)continue;let u=Math.max(1,Math.ceil(h.to.length/a));for(let d=0;d<h.to.length&&o>0;d+=u){let[f,g]=h.to[d];if(f>=t)continue;let v=rg(g),p=this.pulses.add(h.from,f,[...ih(this.dark?cs.signalDark:cs.signal,v),255],n,r);l<0&&(l=p),c++,o--}}c>0&&(this.pulses.flush(l,c),this.until=Math.max(this.until,n+r))}busy(e){return e<=this.until+.05}dispose(){this.links.dispose(),this.pulses.dispose()}};var Da=2048,wM=3e3;function og(i,e,t,n){let s=t.getSize(new k);if(t.isEmpty()||s.length()>wM)return()=>{};let r=n.uSun.value,o=t.getCenter(new k),a=new mo;a.up.set(0,0,1),a.position.copy(o).addScaledVector(r,s.length()+1),a.lookAt(o),a.updateMatrixWorld(!0);let l=new Gn,c=[t.min,t.max];for(let m=0;m<8;m++){let y=new k(c[m&1].x,c[m>>1&1].y,c[m>>2&1].z);l.expandByPoint(y.clone().applyMatrix4(a.matrixWorldInverse)),y.addScaledVector(r,-Math.max(y.z,0)/r.z),l.expandByPoint(y.applyMatrix4(a.matrixWorldInverse))}let h=s.length()*.01+.05;a.left=l.min.x-h,a.right=l.max.x+h,a.bottom=l.min.y-h,a.top=l.max.y+h,a.near=-l.max.z-h,a.far=-l.min.z+h,a.updateProjectionMatrix();let u=new Hi(Da,Da,xi);u.minFilter=u.magFilter=an;let d=new Kn(Da,Da,{depthTexture:u,minFilter:an,magFilter:an}),f=new Wt({vertexShader:`
      void main() {
        vec4 at = vec4(position, 1.0);
        #ifdef USE_INSTANCING
        at = instanceMatrix * at;
        #endif
        gl_Position = projectionMatrix * viewMatrix * at;
      }`,fragmentShader:"void main() { gl_FragColor = vec4(1.0); }",side:ln}),g=new gr;g.overrideMaterial=f;let v=e.parent;g.add(e),i.setRenderTarget(d),i.clear(),i.render(g,a),i.setRenderTarget(null),g.remove(e),v?.add(e),f.dispose(),n.uShadow.value=u,n.uShadowFrom.value.multiplyMatrices(a.projectionMatrix,a.matrixWorldInverse);let p=Math.max(a.right-a.left,a.top-a.bottom)/Da;return n.uShadowDepth.value=p*2/(a.far-a.near)+1e-5,()=>d.dispose()}var Ft=256,EM=2;function TM(i){let e=i>>>0;return()=>{e=e+1831565813>>>0;let t=Math.imul(e^e>>>15,1|e);return t=t+Math.imul(t^t>>>7,61|t)^t,((t^t>>>14)>>>0)/2**32}}var Na=(i,e,t,n)=>`rgb(${Math.round(i*n)} ${Math.round(e*n)} ${Math.round(t*n)})`;function Ar(i,e){i.fillStyle=e,i.fillRect(0,0,Ft,Ft)}function dh(i,e,t){for(let n=0;n<e;n++){let[s,r]=[i()*Ft,i()*Ft];for(let o of[0,-Ft,Ft])for(let a of[0,-Ft,Ft])Math.abs(s+o-Ft/2)<Ft*.75&&Math.abs(r+a-Ft/2)<Ft*.75&&t(s+o,r+a)}}var AM={brick:[1,(i,e)=>{Ar(i,"#b9b0a3");let[t,n]=[8,4],[s,r]=[Ft/t,Ft/n];for(let o=0;o<t;o++)for(let a=0;a<n;a++){let l=a*r+(o%2?r/2:0);i.fillStyle=Na(168,84,62,.82+.32*e());for(let c of[l,l-Ft])i.fillRect(c+2,o*s+2,r-4,s-4)}}],grass:[3,(i,e)=>{Ar(i,"#5d8c3f");for(let t=0;t<3;t++)dh(e,1600,(n,s)=>{i.strokeStyle=Na(104-14*t,152-10*t,66,.65+.5*((n*7+s*13)%1)),i.beginPath(),i.moveTo(n,s),i.lineTo(n+3-n*3.1%6,s-7),i.stroke()})}],metal:[2,(i,e)=>{Ar(i,"#a9b0b6");for(let t=0;t<Ft;t++)i.fillStyle=`rgb(255 255 255 / ${.12*e()})`,i.fillRect(0,t,Ft,1);i.fillStyle="#7f868c";for(let t of[0,Ft/2])i.fillRect(t,0,3,Ft);i.fillRect(0,0,Ft,3)}],sky:[40,(i,e)=>{Ar(i,"#8fc0ea"),dh(e,60,(t,n)=>{let s=i.createRadialGradient(t,n,0,t,n,34);s.addColorStop(0,"rgb(255 255 255 / 0.35)"),s.addColorStop(1,"rgb(255 255 255 / 0)"),i.fillStyle=s,i.fillRect(t-34,n-34,68,68)})}],stone:[2,(i,e)=>{Ar(i,"#6e6a64");let t=6,n=Ft/t;for(let s=0;s<t;s++)for(let r=0;r<t;r++){i.fillStyle=Na(158,153,144,.78+.36*e());let o=r*n+(s%2?n/2:0)+2*e();for(let a of[o,o-Ft])i.beginPath(),i.roundRect(a+2,s*n+2,n-4-4*e(),n-4,9),i.fill()}dh(e,900,(s,r)=>{i.fillStyle="rgb(0 0 0 / 0.08)",i.fillRect(s,r,2,2)})}],tree:[1.5,(i,e)=>{Ar(i,"#2f5a2a");for(let t=0;t<4;t++)dh(e,420,(n,s)=>{i.fillStyle=Na(70+14*t,118+16*t,52,.6+.14*t),i.beginPath(),i.ellipse(n,s,6,3.4,n*s%3.14,0,6.3),i.fill()})}],wood:[1,(i,e)=>{Ar(i,"#a8774a");let t=4,n=Ft/t;for(let s=0;s<t;s++){i.fillStyle=Na(174,126,80,.84+.26*e()),i.fillRect(0,s*n,Ft,n-2);for(let r=0;r<9;r++){i.strokeStyle=`rgb(70 40 15 / ${.12+.16*e()})`;let o=s*n+n*e(),a=4*e();i.beginPath(),i.moveTo(0,o),i.bezierCurveTo(Ft/3,o+a,2*Ft/3,o-a,Ft,o),i.stroke()}i.fillStyle="#5f3f22",i.fillRect(0,(s+1)*n-2,Ft,2)}}]},fh=class{constructor(e){this.changed=e}changed;known=new Map;get(e){if(e==="")return null;let t=this.known.get(e);return t===void 0&&this.known.set(e,t=this.make(e)),t}dispose(){for(let e of this.known.values())e?.texture.dispose()}make(e){let[,t,n]=/^([a-z]+?)(?:_(\d+))?$/.exec(e)??[],s=t===void 0?void 0:AM[t],r={value:s?1:0},o=s?this.paint(s[1],Number(n??0)):this.load(e,r);return o.wrapS=o.wrapT=Ks,o.minFilter=vi,o.generateMipmaps=!0,o.anisotropy=4,{texture:o,tile_m:s?s[0]:EM,ready:r}}paint(e,t){let n=document.createElement("canvas");n.width=n.height=Ft;let s=n.getContext("2d");return s&&e(s,TM(t+7)),new ha(n)}load(e,t){let n=new Un,s=new Image;s.onload=()=>{n.image=s,n.needsUpdate=!0,t.value=1,this.changed()};let r=new URLSearchParams(location.search).get("token"),o=e.split("/").map(encodeURIComponent).join("/");return s.src=`textures/${o}${r?`?token=${encodeURIComponent(r)}`:""}`,n}};var RM=500,Fa=10,CM=30,ag=75,ph=class{constructor(e,t,n){this.frames=e;this.colourOf=n;let s=e.count;this.who=s<=RM?Array.from({length:s},(o,a)=>a):[];let r=s<=50?2.6:s<=150?2:1.4;this.lines=new ri(Math.max(1,this.who.length*(ag+2)),e,t,{width_px:r,fade_s:Fa,order:8}),this.heads=new ri(Math.max(1,this.who.length),e,t,{width_px:r,fade_s:Fa,order:8}),this.own=new ri(4e3,e,t,{width_px:3.4,fade_s:Fa,order:9}),this.ownHead=new ri(1,e,t,{width_px:3.4,fade_s:Fa,order:9}),this.last=new Float64Array(this.who.length*4)}frames;colourOf;lines;heads;own;ownHead;who;last;lastTime=NaN;period=0;selected=null;selectedLast=null;meshes(){return[this.lines,this.heads,this.own,this.ownHead].map(e=>e.mesh)}clear(){for(let e of[this.lines,this.heads,this.own,this.ownHead])e.clear();this.lastTime=NaN,this.selectedLast=null}select(e){e!==this.selected&&(this.selected=e,this.own.clear(),this.ownHead.clear(),this.selectedLast=null)}passed(e){if(e.time<this.lastTime&&this.clear(),e.time===this.lastTime)return;let t=Number.isNaN(this.lastTime);if(t||(this.period=e.time-this.lastTime),!t&&this.period<this.seconds()/ag)return;this.lastTime=e.time;let n=-1,s=0;for(let o=0;o<this.who.length;o++){let a=this.who[o],l=this.pointOf(e,a);if(l){if(!t&&this.last[4*o+3]>0){let c=this.lines.add(this.last.subarray(4*o,4*o+3),l,this.rgba(a),this.last[4*o+3]-1,e.time);n<0&&(n=c),s++}this.last.set([...l,e.time+1],4*o)}}s>0&&this.lines.flush(n,s),this.who.length>0&&(this.heads.clear(),this.who.forEach((o,a)=>this.heads.add(this.last.subarray(4*a,4*a+3),o,this.rgba(o),e.time,e.time+this.period)),this.heads.flush()),this.ownPassed(e)}update(){let e=this.frames.time();for(let t of[this.lines,this.heads,this.own,this.ownHead])t.set("uNow",e),t.set("uFade",this.seconds());this.heads.set("uNow",this.lastTime+this.period),this.ownHead.set("uNow",this.lastTime+this.period)}dispose(){for(let e of[this.lines,this.heads,this.own,this.ownHead])e.dispose()}ownPassed(e){let t=this.selected,n=t===null?null:this.pointOf(e,t);if(t===null||!n)return;let s=this.selectedLast;if(s){let r=this.own.add(s.slice(0,3),n,[...this.colourOf(t),255],s[3],e.time);this.own.flush(r,1)}this.selectedLast=[n[0],n[1],n[2],e.time],this.ownHead.clear(),this.ownHead.add(n,t,[...this.colourOf(t),255],e.time,e.time+this.period),this.ownHead.flush()}seconds(){return Math.max(Fa,CM*this.period)}rgba(e){return[...this.colourOf(e),215]}pointOf(e,t){if(t>=e.n)return null;let n=[e.positions[3*t],e.positions[3*t+1],e.positions[3*t+2]];return n.every(Number.isFinite)?n:null}};function Ua(i){let e=new zt;return e.setAttribute("position",new lt(i.position,3)),e.setAttribute("normal",new lt(i.normal,3)),e.setAttribute("tint",new lt(i.tint,4)),e}function Eo(i,e,t,n){let s=e.index?e.toNonIndexed():e,r=s.getAttribute("position"),o=s.getAttribute("normal"),a=s.getAttribute("tint"),l=new qe().getNormalMatrix(t),c=new k;for(let h=0;h<r.count;h++){c.fromBufferAttribute(r,h);let u=a?[a.getX(h),a.getY(h),a.getZ(h),a.getW(h)]:typeof n=="function"?n(c.x,c.y,c.z):n;c.applyMatrix4(t),i.position.push(c.x,c.y,c.z),c.fromBufferAttribute(o,h).applyMatrix3(l).normalize(),i.normal.push(c.x,c.y,c.z),i.tint.push(u[0],u[1],u[2],u[3])}s!==e&&s.dispose(),e.dispose()}var Ls=[0,0,0,0];function Ed(i,e){let[t,n,s,r]=i.turn;return new it().compose(new k(...i.at),new Vn(n,s,r,t).normalize(),e)}function mh(i){return i.rotateX(Math.PI/2)}function Td(i,e){if("sphere"in i){let s=i.sphere;return{key:"sphere",size:new k(s,s,s),make:r=>mh(new Ts(1,r?28:12,r?18:8))}}if("box"in i)return{key:"box",size:new k(...i.box),make:()=>new ws(2,2,2)};if("cylinder"in i){let[s,r,o]=i.cylinder,a=Math.max(s,r);if(!(a>0))return null;let[l,c]=[Math.round(s/a*100)/100,Math.round(r/a*100)/100];return{key:`cylinder ${l} ${c}`,size:new k(a,a,o),make:h=>mh(new Es(c,l,2,h?32:10))}}if("capsule"in i){let[s,r]=i.capsule;if(!(s>0))return null;let o=Math.round(r/s*50)/50;return{key:`capsule ${o}`,size:new k(s,s,s),make:a=>mh(new fa(1,2*o,a?8:4,a?24:10))}}let{points:t,triangles:n}=i.mesh;return{key:`mesh ${e}`,size:new k(1,1,1),make:()=>Ad(t,n,!1)}}function Ad(i,e,t){let n=Math.floor(i.length/3),s=[];for(let o=0;o+2<e.length;o+=3){let a=e.slice(o,o+3);a.every(l=>l>=0&&l<n)&&s.push(...a)}let r=new zt;return r.setAttribute("position",new lt(i.slice(0,n*3),3)),r.setIndex(s),t||(r=r.toNonIndexed()),r.computeVertexNormals(),r}function hg(i,e,t){let n={position:[],normal:[],tint:[]};for(let s of i){let r=e[s.form],o=r&&Td(r,s.form);o&&Eo(n,o.make(t),Ed(s,o.size),Ls)}return n.position.length>0?Ua(n):null}var lg=(i,e,t,n=1,s=1,r=1)=>new it().makeTranslation(i,e,t).scale(new k(n,s,r));function ug(i){let e={position:[],normal:[],tint:[]},t=[.08,.08,.1,.85],n=new Ts(1,i?10:5,i?12:5).rotateZ(-Math.PI/2),s=r=>r>(i?.72:.7)?[1,1,.97,.92]:i&&r<.42&&Math.floor((r+1)*4.2)%2===0?t:Ls;Eo(e,n,lg(.02,0,0,.62,.3,.27),s);for(let[r,o]of[[1,1],[1,-1],[-1,1],[-1,-1]]){let a=[r*.52,o*.56];if(i){let c=new it().makeTranslation(a[0]/2,a[1]/2,.1).multiply(new it().makeRotationZ(Math.atan2(a[1],a[0]))).scale(new k(Math.hypot(...a),.06,.06));Eo(e,new ws(1,1,1),c,t)}let l=new _r(.33,i?14:6);Eo(e,l,lg(a[0],a[1],.17),r>0?[1,1,1,.3]:[.04,.04,.05,.35])}return Ua(e)}function dg(){let i={position:[],normal:[],tint:[]},e=(h,u,d,f)=>{let[g,v,p]=[h,u,d].map(y=>new k(...y)),m=v.clone().sub(g).cross(p.clone().sub(g)).normalize();for(let y of[g,v,p])i.position.push(y.x,y.y,y.z),i.normal.push(m.x,m.y,m.z),i.tint.push(...f)},[t,n,s,r]=[[1.1,0,0],[-.15,0,.36],[-.15,0,-.3],[-.55,0,0]],[o,a]=[[-.75,.72,.05],[-.75,-.72,.05]],l=[1,1,1,.2],c=[0,0,0,.35];return e(t,o,n,l),e(t,n,a,Ls),e(t,s,o,c),e(t,a,s,c),e(n,o,r,Ls),e(n,r,a,Ls),e(s,r,o,c),e(s,a,r,c),Ua(i)}var cg=[.16,.36,.1,.88];function fg(i){let e={position:[],normal:[],tint:[]};if(Eo(e,mh(new Es(1,1,2,i?6:3,1,!0)),new it,cg),i)for(let t of[.4,3.4]){let n=new zt;n.setAttribute("position",new lt([0,0,-.75,3.2,1.6,-.4,6,0,-.3,0,0,-.75,6,0,-.3,3.2,-1.6,-.4],3)),n.computeVertexNormals(),Eo(e,n,new it().makeRotationZ(t),cg)}return Ua(e)}function pg(i){let e={position:[],normal:[],tint:[]},t=i?7:5,n=(l,c,h,u)=>{e.position.push(l*Math.cos(c),l*Math.sin(c),h),e.normal.push(-.3*Math.cos(c),-.3*Math.sin(c),.95),e.tint.push(...u)},s=[.98,.76,.1,.95],r=[.25,.02,.12,.3],o=[1,1,1,.22];for(let l=0;l<t;l++){let c=2*Math.PI*l/t,h=Math.PI/t*.86;n(.12,c,0,r),n(.72,c-h,.7,Ls),n(1,c,1,o),n(.12,c,0,r),n(1,c,1,o),n(.72,c+h,.7,Ls),i&&(n(.72,c-h,.7,Ls),n(.95,c-h*.6,.95,o),n(1,c,1,o),n(1,c,1,o),n(.95,c+h*.6,.95,o),n(.72,c+h,.7,Ls))}let a=i?8:4;for(let l=0;l<a;l++)n(.3,2*Math.PI*l/a,.6,s),n(.3,2*Math.PI*(l+1)/a,.6,s),n(0,0,1.6,s);return Ua(e)}var Rd=2e3,PM=250,mg=1,IM=`
${La}
attribute vec4 tint;
attribute float vehicle;
uniform vec3 uViewport;
/** The least radius on the screen, in CSS pixels; the radius of the geometry, 0: that of the vehicle. */
uniform float uLeast, uRadius;
varying vec3 vColour, vNormal2, vToEye;
varying float vAway;
void main() {
  vec4 place = placeOf(vehicle);
  vec4 turn = turnOf(vehicle);
  vec4 middle = uSee * vec4(place.xyz, 1.0);
  float pixel = 2.0 * middle.w / (projectionMatrix[1][1] * uViewport.y) * uViewport.z;
  float size = uRadius > 0.0 ? max(1.0, uLeast * pixel / uRadius) : max(place.w, uLeast * pixel);
  vec3 world = place.xyz + turned(turn, position) * size;
  vNormal2 = turned(turn, normal);
  vColour = mix(colourOf(vehicle).rgb, tint.rgb, tint.a);
  vColour *= vColour;
  vToEye = isOrthographic ? vec3(viewMatrix[0][2], viewMatrix[1][2], viewMatrix[2][2]) : cameraPosition - world;
  vAway = middle.w;
  gl_Position = uSee * vec4(world, 1.0);
}
`,LM=`
${Is}
uniform float uOpacity, uGlow;
varying vec3 vColour, vNormal2, vToEye;
varying float vAway;
void main() {
  vec3 n = normalize(vNormal2);
  vec3 eye = normalize(vToEye);
  if (dot(n, eye) < 0.0) n = -n;
  vec3 colour = lit(vColour, n, 1.0) + vColour * uGlow;
  // Edges a little darker, so that a body stands out from one of the same colour behind it.
  colour *= mix(0.62, 1.0, smoothstep(0.0, 0.45, dot(n, eye)));
  gl_FragColor = vec4(toSrgb(mix(colour, hazed(colour, vAway), 0.6)), uOpacity);
}
`,DM=`
${La}
attribute float vehicle;
uniform vec3 uViewport;
uniform float uLeast;
varying vec2 vAt;
varying float vDark;
void main() {
  vec4 place = placeOf(vehicle);
  vec4 middle = uSee * vec4(place.xy, 0.0, 1.0);
  float pixel = 2.0 * middle.w / (projectionMatrix[1][1] * uViewport.y) * uViewport.z;
  float size = max(place.w, uLeast * pixel);
  float height = max(place.z, 0.0) / size;
  // The higher, the wider and the fainter.
  float wide = size * (1.0 + min(height * 0.03, 1.0));
  vDark = 0.5 / (1.0 + height * 0.035);
  vAt = position.xy;
  gl_Position = uSee * vec4(place.xy + position.xy * wide * 1.15, 0.0, 1.0);
  gl_Position.z -= 1e-5 * gl_Position.w;
  if (place.z < -size) gl_Position = vec4(2.0, 2.0, 2.0, 1.0);
}
`,NM=`
varying vec2 vAt;
varying float vDark;
void main() {
  float r = length(vAt);
  if (r > 1.0) discard;
  gl_FragColor = vec4(0.0, 0.02, 0.05, vDark * (1.0 - smoothstep(0.25, 1.0, r)));
}
`;function gg(i,e){let t=new yr;for(let n of Object.keys(i.attributes))t.setAttribute(n,i.getAttribute(n));return t.setIndex(i.index),t.setAttribute("vehicle",new Pi(new Float32Array(e),1)),t.instanceCount=e.length,t}var gh=class{group=new Hn;least;glow={value:.2};constructor(e,t,n){let{roles:s,looks:r}=e.vehicles,o=s.length>Rd;this.least=s.length>Rd?3.2:s.length>300?5:7;let a=new Map;for(let l=0;l<s.length;l++){let c=this.keyOf(e,l,r[l]??-1),h=a.get(c);h?h.push(l):a.set(c,[l])}for(let[l,c]of a){let[h,u]=l.split("|"),d=u==="ghost",f=h==="flyer"?o?dg():ug(s.length<=PM):hg(e.looks[Number(h)]?.pieces??[],e.forms,c.length<200);if(!f)continue;f.computeBoundingSphere();let g=new Wt({vertexShader:IM,fragmentShader:LM,uniforms:{...n,...t.uniforms,uLeast:{value:h==="flyer"?this.least:2.5},uRadius:{value:h==="flyer"?0:Math.max(f.boundingSphere?.radius??1,.001)},uOpacity:{value:d?.42:1},uGlow:this.glow},transparent:d,depthWrite:!d,side:ln}),v=new Bt(gg(f,c),g);v.frustumCulled=!1,v.renderOrder=d?30:5,this.group.add(v)}e.stage.plane&&s.length<=Rd&&s.length>0&&this.addBlobs(e,t,n)}setDark(e){this.glow.value=e?.5:.16}dispose(){this.group.traverse(e=>{e instanceof Bt&&(e.geometry.dispose(),e.material.dispose())})}keyOf(e,t,n){let s=e.vehicles.roles[t]??"vehicle",r=(e.vehicles.radii_m[t]??0)<mg;return`${!e.looks[n]?.pieces.length||r&&s==="vehicle"?"flyer":n}|${s==="ghost"?"ghost":""}`}addBlobs(e,t,n){let s=new _r(1,12),r=new Wt({vertexShader:DM,fragmentShader:NM,uniforms:{...n,...t.uniforms,uLeast:{value:this.least*.7}},transparent:!0,depthWrite:!1}),o=e.vehicles.roles.map((l,c)=>c).filter(l=>(e.vehicles.radii_m[l]??0)<mg),a=new Bt(gg(s,o),r);a.frustumCulled=!1,a.renderOrder=2,this.group.add(a)}};var vg=4e3;function FM(){let i=new Es(.017,.017,.76,6).rotateZ(-Math.PI/2).translate(.38,0,0).toNonIndexed(),e=new pa(.065,.24,10).rotateZ(-Math.PI/2).translate(.88,0,0).toNonIndexed(),t=new zt;for(let n of["position","normal"]){let[s,r]=[i.getAttribute(n),e.getAttribute(n)];t.setAttribute(n,new lt([...s.array,...r.array],3))}return t}var vh=class{mesh;constructor(e){let t=new Wt({uniforms:{...e,uColour:{value:new k(.05,.35,.75)}},vertexShader:`
        varying vec3 vNormal2;
        void main() {
          vNormal2 = mat3(instanceMatrix) * normal;
          gl_Position = projectionMatrix * viewMatrix * instanceMatrix * vec4(position, 1.0);
        }`,fragmentShader:`
        ${Is}
        uniform vec3 uColour;
        varying vec3 vNormal2;
        void main() {
          vec3 n = normalize(vNormal2);
          gl_FragColor = vec4(toSrgb(uColour * (0.75 + 0.4 * n.z)), 0.72);
        }`,transparent:!0});this.mesh=new js(FM(),t,vg),this.mesh.count=0,this.mesh.frustumCulled=!1,this.mesh.renderOrder=18}setDark(e){this.mesh.material.uniforms.uColour.value.set(...e?[.25,.62,.95]:[.04,.26,.62])}set(e){let t=e.filter(o=>o.length>=6&&o.slice(0,6).every(Number.isFinite)).slice(0,vg),n=t.reduce((o,a)=>Math.max(o,Ia([a[3],a[4],a[5]])),0),s=UM(t),r=0;for(let o of t){let a=[o[3],o[4],o[5]],l=Ia(a);if(!(l>n*.01))continue;let c=s*.62*Math.sqrt(l/n),[h,u,d,f]=Vm(a),g=new it().compose(new k(o[0],o[1],o[2]),new Vn(u,d,f,h),new k(c,c,c));this.mesh.setMatrixAt(r++,g)}this.mesh.count=r,this.mesh.instanceMatrix.needsUpdate=!0}dispose(){this.mesh.geometry.dispose(),this.mesh.material.dispose(),this.mesh.dispose()}};function UM(i){let[e,...t]=i;if(!e||t.length===0)return 5;let n=1/0;for(let s of t){let r=Ia([e[0]-s[0],e[1]-s[1],e[2]-s[2]]);r>1e-6&&r<n&&(n=r)}return Number.isFinite(n)?n:5}var OM=12,BM=3e3,kM=`
attribute vec4 colour;
#ifndef MANY
attribute vec3 local, localNormal;
#endif
attribute vec4 tint;
uniform mat4 uSee;
varying vec4 vColour;
varying vec3 vNormal2, vWorld, vLocal, vLocalNormal;
varying float vAway;
void main() {
  #ifdef MANY
  vec3 size = vec3(length(instanceMatrix[0].xyz), length(instanceMatrix[1].xyz), length(instanceMatrix[2].xyz));
  vec3 safe = max(size, 1e-6);
  vec4 world = instanceMatrix * vec4(position, 1.0);
  vNormal2 = mat3(instanceMatrix) * (normal / (safe * safe));
  vLocal = position * size;
  vLocalNormal = normal / safe;
  #else
  vec4 world = vec4(position, 1.0);
  vNormal2 = normal;
  vLocal = local;
  vLocalNormal = localNormal;
  #endif
  vColour = vec4(mix(colour.rgb, tint.rgb, tint.a), colour.a);
  vWorld = world.xyz;
  gl_Position = uSee * world;
  vAway = isOrthographic ? 0.0 : gl_Position.w;
}
`,zM=`
${Is}
${oh}
uniform float uWorldTone, uTile, uReady;
uniform sampler2D uTexture;
varying vec4 vColour;
varying vec3 vNormal2, vWorld, vLocal, vLocalNormal;
varying float vAway;
void main() {
  vec3 n = normalize(vNormal2);
  vec3 base = fromSrgb(vColour.rgb);
  #ifdef TEXTURED
  vec3 w = abs(normalize(vLocalNormal));
  vec2 at = w.z > w.x && w.z > w.y ? vLocal.xy : w.x > w.y ? vLocal.yz : vLocal.xz;
  vec3 picture = texture2D(uTexture, at / uTile).rgb;
  // A thing that is grey shows the picture as it is; one with a colour of its own is dyed.
  float high = max(vColour.r, max(vColour.g, vColour.b));
  float low = min(vColour.r, min(vColour.g, vColour.b));
  float dyed = smoothstep(0.08, 0.3, high > 0.0 ? (high - low) / high : 0.0);
  vec3 natural = fromSrgb(picture);
  base = mix(base, mix(natural, base * dot(picture, vec3(0.5, 0.9, 0.4)), dyed), uReady);
  #endif
  #ifdef BOTH_SIDES
  if (!gl_FrontFacing) n = -n;
  #endif
  float sun = sunAt(vWorld + n * 0.02);
  vec3 colour = lit(base * uWorldTone, n, sun);
  // Less sky is seen close to the ground.
  colour *= 0.82 + 0.18 * smoothstep(0.0, 0.5, vWorld.z);
  gl_FragColor = vec4(toSrgb(hazed(colour, vAway)), vColour.a);
}
`,_h=class{constructor(e,t,n){this.shared=t;this.textures=n;this.props=e.stage.props;let s=this.sort(e.stage.props,e.forms),r=new Map;for(let o of s.values()){let a=this.withTint(o.make());if(this.noteTargets(o,a),o.items.length>=OM)this.addMany(o,a);else{let l=`${o.texture}|${o.clear}|${o.both}`,c=r.get(l);c?c.push({batch:o,geometry:a}):r.set(l,[{batch:o,geometry:a}])}}for(let o of r.values())this.addTogether(o)}shared;textures;group=new Hn;targets=[];props;bounds=new Gn;materials=[];dispose(){this.group.traverse(e=>{e instanceof Bt&&(e.geometry.dispose(),e instanceof js&&e.dispose())});for(let e of this.materials)e.dispose()}sort(e,t){let n=new Map,r=e.reduce((o,a)=>o+(a.kind==="flower"?1:0),0)<BM;return e.forEach((o,a)=>{let l=Ps(o.color),c=l[3]<255,h=o.kind==="flower"&&o.pieces.length>1?HM(o.pieces):-1;o.pieces.forEach((u,d)=>{let f=t[u.form],g=f&&Td(f,u.form);if(!f||!g)return;let v=g.key,p=()=>g.make(!0),m="mesh"in f,y=Ed(u,g.size);o.kind==="flower"&&o.pieces.length>1&&"cylinder"in f?(v=d===h?"bloom":"stem",p=d===h?()=>pg(r):()=>fg(r),m=!0,d===h&&(y=y.multiply(new it().makeRotationZ(a*2.4)))):o.kind==="terrain"&&"mesh"in f&&(p=()=>Ad(f.mesh.points,f.mesh.triangles,!0)),v+=`|${o.texture}|${c}`;let R=n.get(v);R||n.set(v,R={texture:o.texture,clear:c,both:m,make:p,items:[]}),R.items.push({prop:a,matrix:y,colour:VM(l,o,a)})})}),n}withTint(e){return e.getAttribute("tint")||e.setAttribute("tint",new Nn(new Float32Array(e.getAttribute("position").count*4),4)),e}noteTargets(e,t){t.computeBoundingSphere(),t.computeBoundingBox();let n=t.boundingSphere,s=null,r=()=>(s??=(t.index?t.toNonIndexed():t).getAttribute("position").array,s),o=new k;for(let{prop:a,matrix:l}of e.items){o.copy(n.center).applyMatrix4(l);let c=n.radius*l.getMaxScaleOnAxis();this.targets.push({prop:a,matrix:l,triangles:r,ball:[o.x,o.y,o.z,c]}),this.bounds.union(t.boundingBox.clone().applyMatrix4(l))}}addMany(e,t){let n=e.items.length,s=new js(t,this.material(e,!0),n),r=new Uint8Array(n*4);e.items.forEach((o,a)=>{s.setMatrixAt(a,o.matrix),r.set(o.colour,a*4)}),t.setAttribute("colour",new Pi(r,4,!0)),s.frustumCulled=!1,s.renderOrder=e.clear?20:3,this.group.add(s)}addTogether(e){let t=["position","normal","tint","local","localNormal","colour"],n={position:[],normal:[],tint:[],local:[],localNormal:[],colour:[]},s=new k;for(let{batch:l,geometry:c}of e){let h=c.index?c.toNonIndexed():c,[u,d,f]=[h.getAttribute("position"),h.getAttribute("normal"),h.getAttribute("tint")];for(let{matrix:g,colour:v}of l.items){let p=new qe().getNormalMatrix(g),m=new k().setFromMatrixScale(g);for(let y=0;y<u.count;y++)s.fromBufferAttribute(u,y),n.local.push(s.x*m.x,s.y*m.y,s.z*m.z),s.applyMatrix4(g),n.position.push(s.x,s.y,s.z),s.fromBufferAttribute(d,y),n.localNormal.push(s.x/m.x,s.y/m.y,s.z/m.z),s.applyMatrix3(p).normalize(),n.normal.push(s.x,s.y,s.z),n.tint.push(f.getX(y),f.getY(y),f.getZ(y),f.getW(y)),n.colour.push(v[0],v[1],v[2],v[3])}}let r=new zt;for(let l of t)l==="colour"?r.setAttribute(l,new ra(n.colour,4,!0)):r.setAttribute(l,new lt(n[l],l==="tint"?4:3));let o=e[0].batch,a=new Bt(r,this.material(o,!1));a.frustumCulled=!1,a.renderOrder=o.clear?20:3,this.group.add(a)}material(e,t){let n=this.textures.get(e.texture),s=new Wt({vertexShader:kM,fragmentShader:zM,defines:{...t&&{MANY:1},...n&&{TEXTURED:1},...e.both&&{BOTH_SIDES:1}},uniforms:{...this.shared,uTexture:{value:n?.texture??null},uReady:n?.ready??{value:0},uTile:{value:n?.tile_m??1}},transparent:e.clear,side:e.both?ln:ss});return this.materials.push(s),s}};function HM(i){let e=0;return i.forEach((t,n)=>{t.at[2]>i[e].at[2]&&(e=n)}),e}function VM(i,e,t){if(e.kind!=="flower")return i;let n=.86+.14*Math.abs(Math.sin(t*12.9898)*43758.5453%1);return[i[0]*n,i[1]*n,i[2]*n,i[3]]}var GM=60,WM=250,XM={labels:!1,trails:!0,links:!0,packets:!0,beams:!0,wind:!0,grid:!0,world:!0};function xg(i,e){return new Cd(i,e)}var Cd=class{constructor(e,t){this.host=e;this.options=t;let{hello:n}=t;this.dark=t.dark,gt.enabled=!1;let s=qM();this.renderer=new Yc({antialias:!s,powerPreference:"high-performance"}),this.renderer.outputColorSpace=mr,this.renderer.sortObjects=!0;let r=this.renderer.domElement;Object.assign(r.style,{position:"absolute",inset:"0",width:"100%",height:"100%",display:"block",outline:"none"}),r.setAttribute("aria-label","The swarm in three dimensions"),e.append(r,this.overlay.canvas),this.shared=Km(this.dark),this.shared.uShadowFine.value=s?0:1;let o=n.vehicles.paths.length;this.frames=new Qc(o,n.vehicles.radii_m),this.paint=new ch(n,o,h=>t.onLegend(h)),this.textures=new fh(()=>this.changed()),this.world=new _h(n,this.shared,this.textures),this.ground=new ah(n.stage.ground,n.stage.plane,n.stage.radius_m,this.shared),this.vehicles=new gh(n,this.frames,this.shared),this.trails=new ph(this.frames,this.shared,h=>this.paint.colour(h)),this.radio=new uh(this.frames,this.shared),this.beams=new th(this.frames,this.shared,()=>this.reach*4),this.wind=new vh(this.shared),this.drop=new ri(2,this.frames,this.shared,{width_px:1.6,order:9}),this.scene.matrixWorldAutoUpdate=!0,this.scene.add(this.ground.group,this.world.group,this.vehicles.group,...this.trails.meshes()),this.scene.add(this.radio.links.mesh,this.radio.pulses.mesh,this.beams.group,this.wind.mesh,this.drop.mesh),this.ends.push(og(this.renderer,this.world.group,this.world.bounds,this.shared)),this.pace=new hh(this.renderer,s,h=>this.setRatio(h),()=>this.changed(!0)),this.ends.push(tg(r,this.orbit,{moved:()=>this.go(),click:(h,u)=>this.click(h,u),doubleClick:(h,u)=>this.doubleClick(h,u),hover:h=>this.hover(h)}));let a=h=>h.preventDefault(),l=()=>this.changed();r.addEventListener("webglcontextlost",a),r.addEventListener("webglcontextrestored",l);let c=new ResizeObserver(()=>this.resize());c.observe(e),this.ends.push(()=>c.disconnect()),this.setDark(this.dark),this.paintAll(null),this.resize(),this.frameWorld()}host;options;renderer;scene=new gr;shared;orbit=new nh;frames;paint;vehicles;textures;world;ground;trails;radio;beams;wind;drop;overlay=new lh;pace;layers=XM;selected=null;details=null;dark;placed=!1;request=0;lastDraw=0;moving=!1;view=new it;ends=[];hoverAt=null;hoverTimer=0;hovered=null;told="";tellTimer=0;reach=10;disposed=!1;fine=!1;show(e,t,n){let s=this.frames.a,r=this.frames.b;s===e&&r===t&&this.frames.f===n||(this.frames.show(e,t,n),(s!==e||r!==t)&&(this.paintAll(t),this.trails.passed(e)),this.placed||(this.placed=!0,this.frameSwarm(!0)),this.changed())}jumped(){this.trails.clear(),this.changed()}setDark(e){this.dark=e,bd(this.shared,e),this.ground.setDark(e),this.vehicles.setDark(e),this.wind.setDark(e),this.radio.setDark(e),this.overlay.dark=e,this.dropLine(),this.changed()}setLayers(e){this.layers={...e};for(let t of this.trails.meshes())t.visible=e.trails;this.radio.links.mesh.visible=e.links,this.radio.pulses.mesh.visible=e.packets,this.beams.set(e.beams?this.details:null),this.wind.mesh.visible=e.wind,this.ground.showGrid(e.grid),this.world.group.visible=e.world,this.changed()}setColour(e,t,n){this.paint.set(e,t,n),this.paintAll(this.frames.b),this.changed()}select(e){this.selected=e!==null&&e>=0&&e<this.frames.count?e:null,this.trails.select(this.selected),this.details&&this.details.vehicle!==this.selected&&this.setDetails(null),this.dropLine(),this.changed()}follow(e){this.orbit.follow(e===null?null:()=>this.frames.place(e)),this.go()}setView(e){this.orbit.setView(e),this.go()}fit(){this.frameSwarm(!1)}setCamera(e){this.orbit.set(e),this.placed=!0,this.changed()}camera(){return this.orbit.state()}setDetails(e){this.details=e&&e.vehicle===this.selected?e:null,this.beams.set(this.layers.beams?this.details:null),this.changed()}setLinks(e){this.radio.setLinks(e,this.frames.count),this.changed()}addPackets(e,t){!this.layers.packets||e.length===0||(this.radio.addPackets(e,this.frames.count,performance.now()/1e3,t),this.changed())}setWind(e){this.wind.set(e),this.changed()}png(){let{clientWidth:e,clientHeight:t}=this.host;this.pace.begin(!0),this.overlay.resize(e,t,this.pace.ratio),this.draw(performance.now()),this.pace.end();let n=this.renderer.domElement,s=document.createElement("canvas");s.width=n.width,s.height=n.height;let r=s.getContext("2d");return r?.drawImage(n,0,0),r?.drawImage(this.overlay.canvas,0,0,s.width,s.height),this.overlay.resize(e,t,Math.min(devicePixelRatio,2)),this.changed(!0),new Promise((o,a)=>{s.toBlob(l=>l?o(l):a(new Error("the browser made no picture")),"image/png")})}resize(){let{clientWidth:e,clientHeight:t}=this.host;e===0||t===0||(this.orbit.resize(e,t),this.setRatio(this.pace.ratio),this.overlay.resize(e,t,Math.min(devicePixelRatio,2)),this.changed())}stats(){return{drawn:this.pace.drawn,ms:this.pace.ms}}dispose(){this.disposed=!0,cancelAnimationFrame(this.request),clearTimeout(this.hoverTimer),clearTimeout(this.tellTimer);for(let e of this.ends)e();for(let e of[this.pace,this.vehicles,this.world,this.ground,this.trails,this.radio,this.beams,this.wind,this.drop,this.textures,this.frames])e.dispose();this.renderer.dispose(),this.renderer.domElement.remove(),this.overlay.canvas.remove()}go(){this.moving||(this.lastDraw=performance.now()),this.moving=!0,this.changed()}changed(e=!1){this.fine&&=e,!(this.request!==0||this.disposed)&&(this.fine=e,this.request=requestAnimationFrame(t=>{if(this.request=0,this.disposed)return;this.pace.begin(this.fine),this.moving&&(this.moving=this.orbit.step((t-this.lastDraw)/1e3)),this.draw(t),this.pace.end(),(this.moving||this.layers.packets&&this.radio.busy(performance.now()/1e3))&&this.changed(),this.tell()}))}draw(e){this.lastDraw=e;let{hello:t}=this.options,n=this.orbit.target(),s=this.orbit.distance(),r=this.reach+Math.hypot(...n),o=Math.max(r*3,s*14);this.orbit.reach=Math.max(o*1.3,Math.min(t.stage.radius_m,o*4)),this.orbit.apply();let a=s+this.orbit.retreat;this.shared.uHazeRange.value.set(o*.35+a,o*1.25+a),this.shared.uClock.value=performance.now()/1e3,this.ground.update(this.orbit,o*1.6+s*2),this.trails.update(),this.layers.beams&&this.beams.update();let{camera:l}=this.orbit;this.view.multiplyMatrices(l.projectionMatrix,l.matrixWorldInverse),this.shared.uSee.value.copy(this.view),this.renderer.render(this.scene,l),this.overlay.draw({view:this.view.elements,width:this.host.clientWidth,height:this.host.clientHeight,frames:this.frames,names:t.vehicles.paths,labels:this.layers.labels,selected:this.selected,pixel_m:this.orbit.pixel(),flat:this.orbit.isFlat(),grid:this.layers.grid,radius_px:(c,h)=>this.radius_px(c,h)})}setRatio(e){let{clientWidth:t,clientHeight:n}=this.host;t===0||n===0||(this.renderer.setPixelRatio(e),this.renderer.setSize(t,n,!1),this.shared.uViewport.value.set(this.renderer.domElement.width,this.renderer.domElement.height,e))}radius_px(e,t){let n=2*t/(this.orbit.camera.projectionMatrix.elements[5]*Math.max(this.host.clientHeight,1)),s=this.options.hello.vehicles.radii_m[e]??.1;return Math.max(this.vehicles.least,s/n)}paintAll(e){this.paint.update(e),this.frames.colours.image.data.set(this.paint.bytes),this.frames.colours.needsUpdate=!0}dropLine(){this.drop.clear(),this.selected!==null&&this.options.hello.stage.plane&&this.drop.add(this.selected,this.selected,this.dark?[255,213,74,220]:[214,0,108,220]),this.drop.flush()}frameWorld(){let e=this.world.bounds;e.isEmpty()||(this.reach=Math.max(this.reach,e.min.length(),e.max.length()),this.orbit.fit(_g(e),0,!0))}frameSwarm(e){let t=new Gn,n=.05,s=[];for(let l=0;l<this.frames.count;l++){let c=this.frames.place(l);c&&(s.push(c),t.expandByPoint(new k(...c)),n=Math.max(n,this.options.hello.vehicles.radii_m[l]??0))}if(s.length===0)return;let r=t.getSize(new k).length();this.reach=Math.max(this.reach,t.min.length(),t.max.length());let o=this.world.bounds,a=o.isEmpty()?1/0:o.getSize(new k).length();e&&a<Math.max(r,n*20)*1.4&&s.push(..._g(o)),this.orbit.fit(s,Math.max(n*3,r*.03,.3),e),this.go()}click(e,t){this.options.onPick(this.vehicleAt(e,t))}doubleClick(e,t){let n=this.vehicleAt(e,t),s=n===null?this.pointAt(e,t):this.frames.place(n);!s||this.orbit.following()||(this.orbit.lookAt(s),this.go())}vehicleAt(e,t){let{clientWidth:n,clientHeight:s}=this.host,{count:r}=this.frames;return eg(r,o=>this.frames.place(o),this.view.elements,n,s,e,t,(o,a)=>this.radius_px(o,a))}ray(e,t){return this.orbit.ray(2*e/this.host.clientWidth-1,1-2*t/this.host.clientHeight)}pointAt(e,t){let{from:n,along:s}=this.ray(e,t),r=this.layers.world?Md(this.world,n,s):null,o=s[2]<0&&n[2]>0?-n[2]/s[2]:1/0,a=Math.min(r?.away_m??1/0,o);return Number.isFinite(a)?[n[0]+s[0]*a,n[1]+s[1]*a,n[2]+s[2]*a]:null}hover(e){this.hoverAt=e,this.hoverTimer===0&&(this.hoverTimer=window.setTimeout(()=>{this.hoverTimer=0,this.told_hover(this.hoverAt?this.nameAt(this.hoverAt.x,this.hoverAt.y):null)},GM))}told_hover(e){e!==this.hovered&&(this.hovered=e,this.options.onHover(e))}nameAt(e,t){let{hello:n}=this.options,s=this.vehicleAt(e,t);if(this.renderer.domElement.style.cursor=s===null?"":"pointer",s!==null)return`${n.vehicles.paths[s]} · ${n.vehicles.kinds[s]}`;if(!this.layers.world)return null;let{from:r,along:o}=this.ray(e,t),a=Md(this.world,r,o);if(!a)return null;let l=this.world.props[a.target.prop],c=Object.entries(l.meta).map(([h,u])=>`${h} ${u}`);return[l.label||l.kind,...l.label?[l.kind]:[],...c.slice(0,3)].join(" · ")}tell(){this.tellTimer===0&&(this.tellTimer=window.setTimeout(()=>{this.tellTimer=0;let e=this.orbit.state(),t=JSON.stringify(e);t!==this.told&&(this.told=t,this.options.onCamera(e))},WM))}};function qM(){let i=document.createElement("canvas").getContext("webgl2");if(!i)return!1;let e=i.getExtension("WEBGL_debug_renderer_info"),t=String(i.getParameter(e?e.UNMASKED_RENDERER_WEBGL:i.RENDERER));return i.getExtension("WEBGL_lose_context")?.loseContext(),/swiftshader|llvmpipe|softpipe|software|basic render/i.test(t)}function _g(i){let e=[i.min,i.max];return Array.from({length:8},(t,n)=>[e[n&1].x,e[n>>1&1].y,e[n>>2&1].z])}var YM="uplot",$M="u-hz",ZM="u-vt",KM="u-title",JM="u-wrap",jM="u-under",QM="u-over",ew="u-axis",Pr="u-off",tw="u-select",nw="u-cursor-x",iw="u-cursor-y",sw="u-cursor-pt",rw="u-legend",ow="u-live",aw="u-inline",lw="u-series",cw="u-marker",yg="u-label",hw="u-value",Ba="width",ka="height";var bg="bottom",To="left",Pd="right",Yd="#000",Sg=Yd+"0",Id="mousemove",Mg="mousedown",Ld="mouseup",wg="mouseenter",Eg="mouseleave",Tg="dblclick",uw="resize",dw="scroll",Ag="change",Mh="dppxchange",$d="--",Do=typeof window<"u",Od=Do?document:null,Ro=Do?window:null,fw=Do?navigator:null,Ct,xh;function Bd(){let i=devicePixelRatio;Ct!=i&&(Ct=i,xh&&zd(Ag,xh,Bd),xh=matchMedia(`(min-resolution: ${Ct-.001}dppx) and (max-resolution: ${Ct+.001}dppx)`),Ir(Ag,xh,Bd),Ro.dispatchEvent(new CustomEvent(Mh)))}function Si(i,e){if(e!=null){let t=i.classList;!t.contains(e)&&t.add(e)}}function kd(i,e){let t=i.classList;t.contains(e)&&t.remove(e)}function Kt(i,e,t){i.style[e]=t+"px"}function Gi(i,e,t,n){let s=Od.createElement(i);return e!=null&&Si(s,e),t?.insertBefore(s,n),s}function Ii(i,e){return Gi("div",i,e)}var Rg=new WeakMap;function hs(i,e,t,n,s){let r="translate("+e+"px,"+t+"px)",o=Rg.get(i);r!=o&&(i.style.transform=r,Rg.set(i,r),e<0||t<0||e>n||t>s?Si(i,Pr):kd(i,Pr))}var Cg=new WeakMap;function Pg(i,e,t){let n=e+t,s=Cg.get(i);n!=s&&(Cg.set(i,n),i.style.background=e,i.style.borderColor=t)}var Ig=new WeakMap;function Lg(i,e,t,n){let s=e+""+t,r=Ig.get(i);s!=r&&(Ig.set(i,s),i.style.height=t+"px",i.style.width=e+"px",i.style.marginLeft=n?-e/2+"px":0,i.style.marginTop=n?-t/2+"px":0)}var Zd={passive:!0},pw={...Zd,capture:!0};function Ir(i,e,t,n){e.addEventListener(i,t,n?pw:Zd)}function zd(i,e,t,n){e.removeEventListener(i,t,Zd)}Do&&Bd();function Wi(i,e,t,n){let s;t=t||0,n=n||e.length-1;let r=n<=2147483647;for(;n-t>1;)s=r?t+n>>1:Mi((t+n)/2),e[s]<i?t=s:n=s;return i-e[t]<=e[n]-i?t:n}function o0(i){return(t,n,s)=>{let r=-1,o=-1;for(let a=n;a<=s;a++)if(i(t[a])){r=a;break}for(let a=s;a>=n;a--)if(i(t[a])){o=a;break}return[r,o]}}var a0=i=>i!=null,l0=i=>i!=null&&i>0,Th=o0(a0),mw=o0(l0);function gw(i,e,t,n=0,s=!1){let r=s?mw:Th,o=s?l0:a0;[e,t]=r(i,e,t);let a=i[e],l=i[e];if(e>-1)if(n==1)a=i[e],l=i[t];else if(n==-1)a=i[t],l=i[e];else for(let c=e;c<=t;c++){let h=i[c];o(h)&&(h<a?a=h:h>l&&(l=h))}return[a??Ht,l??-Ht]}function Ah(i,e,t,n){let s=Fg(i),r=Fg(e);i==e&&(s==-1?(i*=t,e/=t):(i/=t,e*=t));let o=t==10?Ds:c0,a=s==1?Mi:Li,l=r==1?Li:Mi,c=a(o(wn(i))),h=l(o(wn(e))),u=Co(t,c),d=Co(t,h);return t==10&&(c<0&&(u=Vt(u,-c)),h<0&&(d=Vt(d,-h))),n||t==2?(i=u*s,e=d*r):(i=f0(i,u),e=Rh(e,d)),[i,e]}function Kd(i,e,t,n){let s=Ah(i,e,t,n);return i==0&&(s[0]=0),e==0&&(s[1]=0),s}var Jd=.1,Dg={mode:3,pad:Jd},Ha={pad:0,soft:null,mode:0},vw={min:Ha,max:Ha};function wh(i,e,t,n){return Ch(t)?Ng(i,e,t):(Ha.pad=t,Ha.soft=n?0:null,Ha.mode=n?3:0,Ng(i,e,vw))}function At(i,e){return i??e}function _w(i,e,t){for(e=At(e,0),t=At(t,i.length-1);e<=t;){if(i[e]!=null)return!0;e++}return!1}function Ng(i,e,t){let n=t.min,s=t.max,r=At(n.pad,0),o=At(s.pad,0),a=At(n.hard,-Ht),l=At(s.hard,Ht),c=At(n.soft,Ht),h=At(s.soft,-Ht),u=At(n.mode,0),d=At(s.mode,0),f=e-i,g=Ds(f),v=jn(wn(i),wn(e)),p=Ds(v),m=wn(p-g);(f<1e-24||m>10)&&(f=0,(i==0||e==0)&&(f=1e-24,u==2&&c!=Ht&&(r=0),d==2&&h!=-Ht&&(o=0)));let y=f||v||1e3,R=Ds(y),b=Co(10,Mi(R)),A=y*(f==0?i==0?.1:1:r),E=Vt(f0(i-A,b/10),24),_=i>=c&&(u==1||u==3&&E<=c||u==2&&E>=c)?c:Ht,T=jn(a,E<_&&i>=_?_:Xi(_,E)),O=y*(f==0?e==0?.1:1:o),I=Vt(Rh(e+O,b/10),24),L=e<=h&&(d==1||d==3&&I>=h||d==2&&I<=h)?h:-Ht,H=Xi(l,I>L&&e<=L?L:jn(L,I));return T==H&&T==0&&(H=100),[T,H]}var xw=new Intl.NumberFormat(Do?fw.language:"en-US"),jd=i=>xw.format(i),wi=Math,Sh=wi.PI,wn=wi.abs,Mi=wi.floor,Mn=wi.round,Li=wi.ceil,Xi=wi.min,jn=wi.max,Co=wi.pow,Fg=wi.sign,Ds=wi.log10,c0=wi.log2,yw=(i,e=1)=>wi.sinh(i)*e,Dd=(i,e=1)=>wi.asinh(i/e),Ht=1/0;function Ug(i){return(Ds((i^i>>31)-(i>>31))|0)+1}function Hd(i,e,t){return Xi(jn(i,e),t)}function h0(i){return typeof i=="function"}function St(i){return h0(i)?i:()=>i}var bw=()=>{},u0=i=>i,d0=(i,e)=>e,Sw=i=>null,Og=i=>!0,Bg=(i,e)=>i==e,Mw=/\.\d*?(?=9{6,}|0{6,})/gm,Lr=i=>{if(m0(i)||ar.has(i))return i;let e=`${i}`,t=e.match(Mw);if(t==null)return i;let n=t[0].length-1;if(e.indexOf("e-")!=-1){let[s,r]=e.split("e");return+`${Lr(s)}e${r}`}return Vt(i,n)};function Rr(i,e){return Lr(Vt(Lr(i/e))*e)}function Rh(i,e){return Lr(Li(Lr(i/e))*e)}function f0(i,e){return Lr(Mi(Lr(i/e))*e)}function Vt(i,e=0){if(m0(i))return i;let t=10**e,n=i*t*(1+Number.EPSILON);return Mn(n)/t}var ar=new Map;function p0(i){return((""+i).split(".")[1]||"").length}function Ga(i,e,t,n){let s=[],r=n.map(p0);for(let o=e;o<t;o++){let a=wn(o),l=Vt(Co(i,o),a);for(let c=0;c<n.length;c++){let h=i==10?+`${n[c]}e${o}`:n[c]*l,u=(o>=0?0:a)+(o>=r[c]?0:r[c]),d=i==10?h:Vt(h,u);s.push(d),ar.set(d,u)}}return s}var Va={},Qd=[],Po=[null,null],or=Array.isArray,m0=Number.isInteger,ww=i=>i===void 0;function kg(i){return typeof i=="string"}function Ch(i){let e=!1;if(i!=null){let t=i.constructor;e=t==null||t==Object}return e}function Ew(i){return i!=null&&typeof i=="object"}var Tw=Object.getPrototypeOf(Uint8Array),g0="__proto__";function Io(i,e=Ch){let t;if(or(i)){let n=i.find(s=>s!=null);if(or(n)||e(n)){t=Array(i.length);for(let s=0;s<i.length;s++)t[s]=Io(i[s],e)}else t=i.slice()}else if(i instanceof Tw)t=i.slice();else if(e(i)){t={};for(let n in i)n!=g0&&(t[n]=Io(i[n],e))}else t=i;return t}function _n(i){let e=arguments;for(let t=1;t<e.length;t++){let n=e[t];for(let s in n)s!=g0&&(Ch(i[s])?_n(i[s],Io(n[s])):i[s]=Io(n[s]))}return i}var Aw=0,Rw=1,Cw=2;function Pw(i,e,t){for(let n=0,s,r=-1;n<e.length;n++){let o=e[n];if(o>r){for(s=o-1;s>=0&&i[s]==null;)i[s--]=null;for(s=o+1;s<t&&i[s]==null;)i[r=s++]=null}}}function Iw(i,e){if(Nw(i)){let o=i[0].slice();for(let a=1;a<i.length;a++)o.push(...i[a].slice(1));return Fw(o[0])||(o=Dw(o)),o}let t=new Set;for(let o=0;o<i.length;o++){let l=i[o][0],c=l.length;for(let h=0;h<c;h++)t.add(l[h])}let n=[Array.from(t).sort((o,a)=>o-a)],s=n[0].length,r=new Map;for(let o=0;o<s;o++)r.set(n[0][o],o);for(let o=0;o<i.length;o++){let a=i[o],l=a[0];for(let c=1;c<a.length;c++){let h=a[c],u=Array(s).fill(void 0),d=e?e[o][c]:Rw,f=[];for(let g=0;g<h.length;g++){let v=h[g],p=r.get(l[g]);v===null?d!=Aw&&(u[p]=v,d==Cw&&f.push(p)):u[p]=v}Pw(u,f,s),n.push(u)}}return n}var Lw=typeof queueMicrotask>"u"?i=>Promise.resolve().then(i):queueMicrotask;function Dw(i){let e=i[0],t=e.length,n=Array(t);for(let r=0;r<n.length;r++)n[r]=r;n.sort((r,o)=>e[r]-e[o]);let s=[];for(let r=0;r<i.length;r++){let o=i[r],a=Array(t);for(let l=0;l<t;l++)a[l]=o[n[l]];s.push(a)}return s}function Nw(i){let e=i[0][0],t=e.length;for(let n=1;n<i.length;n++){let s=i[n][0];if(s.length!=t)return!1;if(s!=e){for(let r=0;r<t;r++)if(s[r]!=e[r])return!1}}return!0}function Fw(i,e=100){let t=i.length;if(t<=1)return!0;let n=0,s=t-1;for(;n<=s&&i[n]==null;)n++;for(;s>=n&&i[s]==null;)s--;if(s<=n)return!0;let r=jn(1,Mi((s-n+1)/e));for(let o=i[n],a=n+r;a<=s;a+=r){let l=i[a];if(l!=null){if(l<=o)return!1;o=l}}return!0}var v0=["January","February","March","April","May","June","July","August","September","October","November","December"],_0=["Sunday","Monday","Tuesday","Wednesday","Thursday","Friday","Saturday"];function x0(i){return i.slice(0,3)}var Uw=_0.map(x0),Ow=v0.map(x0),Bw={MMMM:v0,MMM:Ow,WWWW:_0,WWW:Uw};function Oa(i){return(i<10?"0":"")+i}function kw(i){return(i<10?"00":i<100?"0":"")+i}var zw={YYYY:i=>i.getFullYear(),YY:i=>(i.getFullYear()+"").slice(2),MMMM:(i,e)=>e.MMMM[i.getMonth()],MMM:(i,e)=>e.MMM[i.getMonth()],MM:i=>Oa(i.getMonth()+1),M:i=>i.getMonth()+1,DD:i=>Oa(i.getDate()),D:i=>i.getDate(),WWWW:(i,e)=>e.WWWW[i.getDay()],WWW:(i,e)=>e.WWW[i.getDay()],HH:i=>Oa(i.getHours()),H:i=>i.getHours(),h:i=>{let e=i.getHours();return e==0?12:e>12?e-12:e},AA:i=>i.getHours()>=12?"PM":"AM",aa:i=>i.getHours()>=12?"pm":"am",a:i=>i.getHours()>=12?"p":"a",mm:i=>Oa(i.getMinutes()),m:i=>i.getMinutes(),ss:i=>Oa(i.getSeconds()),s:i=>i.getSeconds(),fff:i=>kw(i.getMilliseconds())};function ef(i,e){e=e||Bw;let t=[],n=/\{([a-z]+)\}|[^{]+/gi,s;for(;s=n.exec(i);)t.push(s[0][0]=="{"?zw[s[1]]:s[0]);return r=>{let o="";for(let a=0;a<t.length;a++)o+=typeof t[a]=="string"?t[a]:t[a](r,e);return o}}var Hw=new Intl.DateTimeFormat().resolvedOptions().timeZone;function Vw(i,e){let t;return e=="UTC"||e=="Etc/UTC"?t=new Date(+i+i.getTimezoneOffset()*6e4):e==Hw?t=i:(t=new Date(i.toLocaleString("en-US",{timeZone:e})),t.setMilliseconds(i.getMilliseconds())),t}var y0=i=>i%1==0,Eh=[1,2,2.5,5],Gw=Ga(10,-32,0,Eh),b0=Ga(10,0,32,Eh),Ww=b0.filter(y0),Cr=Gw.concat(b0),tf=`
`,S0="{YYYY}",zg=tf+S0,M0="{M}/{D}",za=tf+M0,yh=za+"/{YY}",w0="{aa}",Xw="{h}:{mm}",Ao=Xw+w0,Hg=tf+Ao,Vg=":{ss}",It=null;function E0(i){let e=i*1e3,t=e*60,n=t*60,s=n*24,r=s*30,o=s*365,l=(i==1?Ga(10,0,3,Eh).filter(y0):Ga(10,-3,0,Eh)).concat([e,e*5,e*10,e*15,e*30,t,t*5,t*10,t*15,t*30,n,n*2,n*3,n*4,n*6,n*8,n*12,s,s*2,s*3,s*4,s*5,s*6,s*7,s*8,s*9,s*10,s*15,r,r*2,r*3,r*4,r*6,o,o*2,o*5,o*10,o*25,o*50,o*100]),c=[[o,S0,It,It,It,It,It,It,1],[s*28,"{MMM}",zg,It,It,It,It,It,1],[s,M0,zg,It,It,It,It,It,1],[n,"{h}"+w0,yh,It,za,It,It,It,1],[t,Ao,yh,It,za,It,It,It,1],[e,Vg,yh+" "+Ao,It,za+" "+Ao,It,Hg,It,1],[i,Vg+".{fff}",yh+" "+Ao,It,za+" "+Ao,It,Hg,It,1]];function h(u){return(d,f,g,v,p,m)=>{let y=[],R=p>=o,b=p>=r&&p<o,A=u(g),E=Vt(A*i,3),_=Nd(A.getFullYear(),R?0:A.getMonth(),b||R?1:A.getDate()),T=Vt(_*i,3);if(b||R){let O=b?p/r:0,I=R?p/o:0,L=E==T?E:Vt(Nd(_.getFullYear()+I,_.getMonth()+O,1)*i,3),H=new Date(Mn(L/i)),V=H.getFullYear(),N=H.getMonth();for(let X=0;L<=v;X++){let $=Nd(V+I*X,N+O*X,1),W=$-u(Vt($*i,3));L=Vt((+$+W)*i,3),L<=v&&y.push(L)}}else{let O=p>=s?s:p,I=Mi(g)-Mi(E),L=T+I+Rh(E-T,O);y.push(L);let H=u(L),V=H.getHours()+H.getMinutes()/t+H.getSeconds()/n,N=p/n,X=d.axes[f]._space,$=m/X;for(;L=Vt(L+p,i==1?0:3),!(L>v);)if(N>1){let W=Mi(Vt(V+N,6))%24,Q=u(L).getHours()-W;Q>1&&(Q=-1),L-=Q*n,V=(V+N)%24;let se=y[y.length-1];Vt((L-se)/p,3)*$>=.7&&y.push(L)}else y.push(L)}return y}}return[l,c,h]}var[qw,Yw,$w]=E0(1),[Zw,Kw,Jw]=E0(.001);Ga(2,-53,53,[1]);function Gg(i,e){return i.map(t=>t.map((n,s)=>s==0||s==8||n==null?n:e(s==1||t[8]==0?n:t[1]+n)))}function Wg(i,e){return(t,n,s,r,o)=>{let a=e.find(g=>o>=g[0])||e[e.length-1],l,c,h,u,d,f;return n.map(g=>{let v=i(g),p=v.getFullYear(),m=v.getMonth(),y=v.getDate(),R=v.getHours(),b=v.getMinutes(),A=v.getSeconds(),E=p!=l&&a[2]||m!=c&&a[3]||y!=h&&a[4]||R!=u&&a[5]||b!=d&&a[6]||A!=f&&a[7]||a[1];return l=p,c=m,h=y,u=R,d=b,f=A,E(v)})}}function jw(i,e){let t=ef(e);return(n,s,r,o,a)=>s.map(l=>t(i(l)))}function Nd(i,e,t){return new Date(i,e,t)}function Xg(i,e){return e(i)}var Qw="{YYYY}-{MM}-{DD} {h}:{mm}{aa}";function qg(i,e){return(t,n,s,r)=>r==null?$d:e(i(n))}function eE(i,e){let t=i.series[e];return t.width?t.stroke(i,e):t.points.width?t.points.stroke(i,e):null}function tE(i,e){return i.series[e].fill(i,e)}var nE={show:!0,live:!0,isolate:!1,mount:bw,markers:{show:!0,width:2,stroke:eE,fill:tE,dash:"solid"},idx:null,idxs:null,values:[]};function iE(i,e){let t=i.cursor.points,n=Ii(),s=t.size(i,e);Kt(n,Ba,s),Kt(n,ka,s);let r=s/-2;Kt(n,"marginLeft",r),Kt(n,"marginTop",r);let o=t.width(i,e,s);return o&&Kt(n,"borderWidth",o),n}function sE(i,e){let t=i.series[e].points;return t._fill||t._stroke}function rE(i,e){let t=i.series[e].points;return t._stroke||t._fill}function oE(i,e){return i.series[e].points.size}var Fd=[0,0];function aE(i,e,t){return Fd[0]=e,Fd[1]=t,Fd}function bh(i,e,t,n=!0){return s=>{s.button==0&&(!n||s.target==e)&&t(s)}}function Ud(i,e,t,n=!0){return s=>{(!n||s.target==e)&&t(s)}}var lE={show:!0,x:!0,y:!0,lock:!1,move:aE,points:{one:!1,show:iE,size:oE,width:0,stroke:rE,fill:sE},bind:{mousedown:bh,mouseup:bh,click:bh,dblclick:bh,mousemove:Ud,mouseleave:Ud,mouseenter:Ud},drag:{setScale:!0,x:!0,y:!1,dist:0,uni:null,click:(i,e)=>{e.stopPropagation(),e.stopImmediatePropagation()},_x:!1,_y:!1},focus:{dist:(i,e,t,n,s)=>n-s,prox:-1,bias:0},hover:{skip:[void 0],prox:null,bias:0},left:-10,top:-10,idx:null,dataIdx:null,idxs:null,event:null},T0={show:!0,stroke:"rgba(0,0,0,0.07)",width:2},nf=_n({},T0,{filter:d0}),A0=_n({},nf,{size:10}),R0=_n({},T0,{show:!1}),sf='12px system-ui, -apple-system, "Segoe UI", Roboto, "Helvetica Neue", Arial, "Noto Sans", sans-serif, "Apple Color Emoji", "Segoe UI Emoji", "Segoe UI Symbol", "Noto Color Emoji"',C0="bold "+sf,P0=1.5,Yg={show:!0,scale:"x",stroke:Yd,space:50,gap:5,alignTo:1,size:50,labelGap:0,labelSize:30,labelFont:C0,side:2,grid:nf,ticks:A0,border:R0,font:sf,lineGap:P0,rotate:0},cE="Value",hE="Time",$g={show:!0,scale:"x",auto:!1,sorted:1,min:Ht,max:-Ht,idxs:[]};function uE(i,e,t,n,s){return e.map(r=>r==null?"":jd(r))}function dE(i,e,t,n,s,r,o){let a=[],l=ar.get(s)||0;t=o?t:Vt(Rh(t,s),l);for(let c=t;c<=n;c=Vt(c+s,l))a.push(Object.is(c,-0)?0:c);return a}function Vd(i,e,t,n,s,r,o){let a=[],l=i.scales[i.axes[e].scale].log,c=l==10?Ds:c0,h=Mi(c(t));s=Co(l,h),l==10&&(s=Cr[Wi(s,Cr)]);let u=t,d=s*l;l==10&&(d=Cr[Wi(d,Cr)]);do a.push(u),u=u+s,l==10&&!ar.has(u)&&(u=Vt(u,ar.get(s))),u>=d&&(s=u,d=s*l,l==10&&(d=Cr[Wi(d,Cr)]));while(u<=n);return a}function fE(i,e,t,n,s,r,o){let l=i.scales[i.axes[e].scale].asinh,c=n>l?Vd(i,e,jn(l,t),n,s):[l],h=n>=0&&t<=0?[0]:[];return(t<-l?Vd(i,e,jn(l,-n),-t,s):[l]).reverse().map(d=>-d).concat(h,c)}var I0=/./,pE=/[12357]/,mE=/[125]/,Zg=/1/,Gd=(i,e,t,n)=>i.map((s,r)=>e==4&&s==0||r%n==0&&t.test(s.toExponential()[s<0?1:0])?s:null);function gE(i,e,t,n,s){let r=i.axes[t],o=r.scale,a=i.scales[o],l=i.valToPos,c=r._space,h=l(10,o),u=l(9,o)-h>=c?I0:l(7,o)-h>=c?pE:l(5,o)-h>=c?mE:Zg;if(u==Zg){let d=wn(l(1,o)-h);if(d<c)return Gd(e.slice().reverse(),a.distr,u,Li(c/d)).reverse()}return Gd(e,a.distr,u,1)}function vE(i,e,t,n,s){let r=i.axes[t],o=r.scale,a=r._space,l=i.valToPos,c=wn(l(1,o)-l(2,o));return c<a?Gd(e.slice().reverse(),3,I0,Li(a/c)).reverse():e}function _E(i,e,t,n){return n==null?$d:e==null?"":jd(e)}var Kg={show:!0,scale:"y",stroke:Yd,space:30,gap:5,alignTo:1,size:50,labelGap:0,labelSize:30,labelFont:C0,side:3,grid:nf,ticks:A0,border:R0,font:sf,lineGap:P0,rotate:0};function xE(i,e){let t=3+(i||1)*2;return Vt(t*e,3)}function yE(i,e){let{scale:t,idxs:n}=i.series[0],s=i._data[0],r=i.valToPos(s[n[0]],t,!0),o=i.valToPos(s[n[1]],t,!0),a=wn(o-r),l=i.series[e],c=a/(l.points.space*Ct);return n[1]-n[0]<=c}var Jg={scale:null,auto:!0,sorted:0,min:Ht,max:-Ht},L0=(i,e,t,n,s)=>s,jg={show:!0,auto:!0,sorted:0,gaps:L0,alpha:1,facets:[_n({},Jg,{scale:"x"}),_n({},Jg,{scale:"y"})]},Qg={scale:"y",auto:!0,sorted:0,show:!0,spanGaps:!1,gaps:L0,alpha:1,points:{show:yE,filter:null},values:null,min:Ht,max:-Ht,idxs:[],path:null,clip:null};function bE(i,e,t,n,s){return t/10}var D0={time:!0,auto:!0,distr:1,log:10,asinh:1,min:null,max:null,dir:1,ori:0},SE=_n({},D0,{time:!1,ori:1}),e0={};function N0(i,e){let t=e0[i];return t||(t={key:i,plots:[],sub(n){t.plots.push(n)},unsub(n){t.plots=t.plots.filter(s=>s!=n)},pub(n,s,r,o,a,l,c){for(let h=0;h<t.plots.length;h++)t.plots[h]!=s&&t.plots[h].pub(n,s,r,o,a,l,c)}},i!=null&&(e0[i]=t)),t}var Lo=1,Wd=2;function Dr(i,e,t){let n=i.mode,s=i.series[e],r=n==2?i._data[e]:i._data,o=i.scales,a=i.bbox,l=r[0],c=n==2?r[1]:r[e],h=n==2?o[s.facets[0].scale]:o[i.series[0].scale],u=n==2?o[s.facets[1].scale]:o[s.scale],d=a.left,f=a.top,g=a.width,v=a.height,p=i.valToPosH,m=i.valToPosV;return h.ori==0?t(s,l,c,h,u,p,m,d,f,g,v,Ih,No,Dh,U0,B0):t(s,l,c,h,u,m,p,f,d,v,g,Lh,Fo,af,O0,k0)}function rf(i,e){let t=0,n=0,s=At(i.bands,Qd);for(let r=0;r<s.length;r++){let o=s[r];o.series[0]==e?t=o.dir:o.series[1]==e&&(o.dir==1?n|=1:n|=2)}return[t,n==1?-1:n==2?1:n==3?2:0]}function ME(i,e,t,n,s){let r=i.mode,o=i.series[e],a=r==2?o.facets[1].scale:o.scale,l=i.scales[a];return s==-1?l.min:s==1?l.max:l.distr==3?l.dir==1?l.min:l.max:0}function Ns(i,e,t,n,s,r){return Dr(i,e,(o,a,l,c,h,u,d,f,g,v,p)=>{let m=o.pxRound,y=c.dir*(c.ori==0?1:-1),R=c.ori==0?No:Fo,b,A;y==1?(b=t,A=n):(b=n,A=t);let E=m(u(a[b],c,v,f)),_=m(d(l[b],h,p,g)),T=m(u(a[A],c,v,f)),O=m(d(r==1?h.max:h.min,h,p,g)),I=new Path2D(s);return R(I,T,O),R(I,E,O),R(I,E,_),I})}function Ph(i,e,t,n,s,r){let o=null;if(i.length>0){o=new Path2D;let a=e==0?Dh:af,l=t;for(let u=0;u<i.length;u++){let d=i[u];if(d[1]>d[0]){let f=d[0]-l;f>0&&a(o,l,n,f,n+r),l=d[1]}}let c=t+s-l,h=10;c>0&&a(o,l,n-h/2,c,n+r+h)}return o}function wE(i,e,t){let n=i[i.length-1];n&&n[0]==e?n[1]=t:i.push([e,t])}function of(i,e,t,n,s,r,o){let a=[],l=i.length;for(let c=s==1?t:n;c>=t&&c<=n;c+=s)if(e[c]===null){let u=c,d=c;if(s==1)for(;++c<=n&&e[c]===null;)d=c;else for(;--c>=t&&e[c]===null;)d=c;let f=r(i[u]),g=d==u?f:r(i[d]),v=u-s;f=o<=0&&v>=0&&v<l?r(i[v]):f;let m=d+s;g=o>=0&&m>=0&&m<l?r(i[m]):g,g>=f&&a.push([f,g])}return a}function t0(i){return i==0?u0:i==1?Mn:e=>Rr(e,i)}function F0(i){let e=i==0?Ih:Lh,t=i==0?(s,r,o,a,l,c)=>{s.arcTo(r,o,a,l,c)}:(s,r,o,a,l,c)=>{s.arcTo(o,r,l,a,c)},n=i==0?(s,r,o,a,l)=>{s.rect(r,o,a,l)}:(s,r,o,a,l)=>{s.rect(o,r,l,a)};return(s,r,o,a,l,c=0,h=0)=>{c==0&&h==0?n(s,r,o,a,l):(c=Xi(c,a/2,l/2),h=Xi(h,a/2,l/2),e(s,r+c,o),t(s,r+a,o,r+a,o+l,c),t(s,r+a,o+l,r,o+l,h),t(s,r,o+l,r,o,h),t(s,r,o,r+a,o,c),s.closePath())}}var Ih=(i,e,t)=>{i.moveTo(e,t)},Lh=(i,e,t)=>{i.moveTo(t,e)},No=(i,e,t)=>{i.lineTo(e,t)},Fo=(i,e,t)=>{i.lineTo(t,e)},Dh=F0(0),af=F0(1),U0=(i,e,t,n,s,r)=>{i.arc(e,t,n,s,r)},O0=(i,e,t,n,s,r)=>{i.arc(t,e,n,s,r)},B0=(i,e,t,n,s,r,o)=>{i.bezierCurveTo(e,t,n,s,r,o)},k0=(i,e,t,n,s,r,o)=>{i.bezierCurveTo(t,e,s,n,o,r)};function z0(i){return(e,t,n,s,r)=>Dr(e,t,(o,a,l,c,h,u,d,f,g,v,p)=>{let{pxRound:m,points:y}=o,R,b;c.ori==0?(R=Ih,b=U0):(R=Lh,b=O0);let A=Vt(y.width*Ct,3),E=(y.size-y.width)/2*Ct,_=Vt(E*2,3),T=new Path2D,O=new Path2D,{left:I,top:L,width:H,height:V}=e.bbox;Dh(O,I-_,L-_,H+_*2,V+_*2);let N=X=>{if(l[X]!=null){let $=m(u(a[X],c,v,f)),W=m(d(l[X],h,p,g));R(T,$+E,W),b(T,$,W,E,0,Sh*2)}};if(r)r.forEach(N);else for(let X=n;X<=s;X++)N(X);return{stroke:A>0?T:null,fill:T,clip:O,flags:Lo|Wd}})}function H0(i){return(e,t,n,s,r,o)=>{n!=s&&(r!=n&&o!=n&&i(e,t,n),r!=s&&o!=s&&i(e,t,s),i(e,t,o))}}var EE=H0(No),TE=H0(Fo);function V0(i){let e=At(i?.alignGaps,0);return(t,n,s,r)=>Dr(t,n,(o,a,l,c,h,u,d,f,g,v,p)=>{[s,r]=Th(l,s,r);let m=o.pxRound,y=V=>m(u(V,c,v,f)),R=V=>m(d(V,h,p,g)),b,A;c.ori==0?(b=No,A=EE):(b=Fo,A=TE);let E=c.dir*(c.ori==0?1:-1),_={stroke:new Path2D,fill:null,clip:null,band:null,gaps:null,flags:Lo},T=_.stroke,O=!1;if(r-s>=v*4){let V=ue=>t.posToVal(ue,c.key,!0),N=null,X=null,$,W,ce,J=y(a[E==1?s:r]),Q=y(a[s]),se=y(a[r]),de=V(E==1?Q+1:se-1);for(let ue=E==1?s:r;ue>=s&&ue<=r;ue+=E){let ee=a[ue],_e=(E==1?ee<de:ee>de)?J:y(ee),Ae=l[ue];_e==J?Ae!=null?(W=Ae,N==null?(b(T,_e,R(W)),$=N=X=W):W<N?N=W:W>X&&(X=W)):Ae===null&&(O=!0):(N!=null&&A(T,J,R(N),R(X),R($),R(W)),Ae!=null?(W=Ae,b(T,_e,R(W)),N=X=$=W):(N=X=null,Ae===null&&(O=!0)),J=_e,de=V(J+E))}N!=null&&N!=X&&ce!=J&&A(T,J,R(N),R(X),R($),R(W))}else for(let V=E==1?s:r;V>=s&&V<=r;V+=E){let N=l[V];N===null?O=!0:N!=null&&b(T,y(a[V]),R(N))}let[L,H]=rf(t,n);if(o.fill!=null||L!=0){let V=_.fill=new Path2D(T),N=o.fillTo(t,n,o.min,o.max,L),X=R(N),$=y(a[s]),W=y(a[r]);E==-1&&([W,$]=[$,W]),b(V,W,X),b(V,$,X)}if(!o.spanGaps){let V=[];O&&V.push(...of(a,l,s,r,E,y,e)),_.gaps=V=o.gaps(t,n,s,r,V),_.clip=Ph(V,c.ori,f,g,v,p)}return H!=0&&(_.band=H==2?[Ns(t,n,s,r,T,-1),Ns(t,n,s,r,T,1)]:Ns(t,n,s,r,T,H)),_})}function AE(i){let e=At(i.align,1),t=At(i.ascDesc,!1),n=At(i.alignGaps,0),s=At(i.extend,!1);return(r,o,a,l)=>Dr(r,o,(c,h,u,d,f,g,v,p,m,y,R)=>{[a,l]=Th(u,a,l);let b=c.pxRound,{left:A,width:E}=r.bbox,_=Q=>b(g(Q,d,y,p)),T=Q=>b(v(Q,f,R,m)),O=d.ori==0?No:Fo,I={stroke:new Path2D,fill:null,clip:null,band:null,gaps:null,flags:Lo},L=I.stroke,H=d.dir*(d.ori==0?1:-1),V=T(u[H==1?a:l]),N=_(h[H==1?a:l]),X=N,$=N;s&&e==-1&&($=A,O(L,$,V)),O(L,N,V);for(let Q=H==1?a:l;Q>=a&&Q<=l;Q+=H){let se=u[Q];if(se==null)continue;let de=_(h[Q]),ue=T(se);e==1?O(L,de,V):O(L,X,ue),O(L,de,ue),V=ue,X=de}let W=X;s&&e==1&&(W=A+E,O(L,W,V));let[ce,J]=rf(r,o);if(c.fill!=null||ce!=0){let Q=I.fill=new Path2D(L),se=c.fillTo(r,o,c.min,c.max,ce),de=T(se);O(Q,W,de),O(Q,$,de)}if(!c.spanGaps){let Q=[];Q.push(...of(h,u,a,l,H,_,n));let se=c.width*Ct/2,de=t||e==1?se:-se,ue=t||e==-1?-se:se;Q.forEach(ee=>{ee[0]+=de,ee[1]+=ue}),I.gaps=Q=c.gaps(r,o,a,l,Q),I.clip=Ph(Q,d.ori,p,m,y,R)}return J!=0&&(I.band=J==2?[Ns(r,o,a,l,L,-1),Ns(r,o,a,l,L,1)]:Ns(r,o,a,l,L,J)),I})}function n0(i,e,t,n,s,r,o=Ht){if(i.length>1){let a=null;for(let l=0,c=1/0;l<i.length;l++)if(e[l]!==void 0){if(a!=null){let h=wn(i[l]-i[a]);h<c&&(c=h,o=wn(t(i[l],n,s,r)-t(i[a],n,s,r)))}a=l}}return o}function RE(i){i=i||Va;let e=At(i.size,[.6,Ht,1]),t=i.align||0,n=i.gap||0,s=i.radius;s=s==null?[0,0]:typeof s=="number"?[s,0]:s;let r=St(s),o=1-e[0],a=At(e[1],Ht),l=At(e[2],1),c=At(i.disp,Va),h=At(i.each,f=>{}),{fill:u,stroke:d}=c;return(f,g,v,p)=>Dr(f,g,(m,y,R,b,A,E,_,T,O,I,L)=>{let H=m.pxRound,V=t,N=n*Ct,X=a*Ct,$=l*Ct,W,ce;b.ori==0?[W,ce]=r(f,g):[ce,W]=r(f,g);let J=b.dir*(b.ori==0?1:-1),Q=b.ori==0?Dh:af,se=b.ori==0?h:(Ce,Ye,rt,Me,kt,ze,Xe)=>{h(Ce,Ye,rt,kt,Me,Xe,ze)},de=At(f.bands,Qd).find(Ce=>Ce.series[0]==g),ue=de!=null?de.dir:0,ee=m.fillTo(f,g,m.min,m.max,ue),me=H(_(ee,A,L,O)),_e,Ae,Se,Ge=I,st=H(m.width*Ct),He=!1,ft=null,ct=null,tt=null,Jt=null;u!=null&&(st==0||d!=null)&&(He=!0,ft=u.values(f,g,v,p),ct=new Map,new Set(ft).forEach(Ce=>{Ce!=null&&ct.set(Ce,new Path2D)}),st>0&&(tt=d.values(f,g,v,p),Jt=new Map,new Set(tt).forEach(Ce=>{Ce!=null&&Jt.set(Ce,new Path2D)})));let{x0:Gt,size:un}=c;if(Gt!=null&&un!=null){V=1,y=Gt.values(f,g,v,p),Gt.unit==2&&(y=y.map(rt=>f.posToVal(T+rt*I,b.key,!0)));let Ce=un.values(f,g,v,p);un.unit==2?Ae=Ce[0]*I:Ae=E(Ce[0],b,I,T)-E(0,b,I,T),Ge=n0(y,R,E,b,I,T,Ge),Se=Ge-Ae+N}else Ge=n0(y,R,E,b,I,T,Ge),Se=Ge*o+N,Ae=Ge-Se;Se<1&&(Se=0),st>=Ae/2&&(st=0),Se<5&&(H=u0);let Ut=Se>0,En=Ge-Se-(Ut?st:0);Ae=H(Hd(En,$,X)),_e=(V==0?Ae/2:V==J?0:Ae)-V*J*((V==0?N/2:0)+(Ut?st/2:0));let wt={stroke:null,fill:null,clip:null,band:null,gaps:null,flags:0},xn=He?null:new Path2D,tn=null;if(de!=null)tn=f.data[de.series[1]];else{let{y0:Ce,y1:Ye}=c;Ce!=null&&Ye!=null&&(R=Ye.values(f,g,v,p),tn=Ce.values(f,g,v,p))}let dn=W*Ae,U=ce*Ae;for(let Ce=J==1?v:p;Ce>=v&&Ce<=p;Ce+=J){let Ye=R[Ce];if(Ye==null)continue;if(tn!=null){let q=tn[Ce]??0;if(Ye-q==0)continue;me=_(q,A,L,O)}let rt=b.distr!=2||c!=null?y[Ce]:Ce,Me=E(rt,b,I,T),kt=_(At(Ye,ee),A,L,O),ze=H(Me-_e),Xe=H(jn(kt,me)),C=H(Xi(kt,me)),S=Xe-C;if(Ye!=null){let q=Ye<0?U:dn,he=Ye<0?dn:U;He?(st>0&&tt[Ce]!=null&&Q(Jt.get(tt[Ce]),ze,C+Mi(st/2),Ae,jn(0,S-st),q,he),ft[Ce]!=null&&Q(ct.get(ft[Ce]),ze,C+Mi(st/2),Ae,jn(0,S-st),q,he)):Q(xn,ze,C+Mi(st/2),Ae,jn(0,S-st),q,he),se(f,g,Ce,ze-st/2,C,Ae+st,S)}}return st>0?wt.stroke=He?Jt:xn:He||(wt._fill=m.width==0?m._fill:m._stroke??m._fill,wt.width=0),wt.fill=He?ct:xn,wt})}function CE(i,e){let t=At(e?.alignGaps,0);return(n,s,r,o)=>Dr(n,s,(a,l,c,h,u,d,f,g,v,p,m)=>{[r,o]=Th(c,r,o);let y=a.pxRound,R=W=>y(d(W,h,p,g)),b=W=>y(f(W,u,m,v)),A,E,_;h.ori==0?(A=Ih,_=No,E=B0):(A=Lh,_=Fo,E=k0);let T=h.dir*(h.ori==0?1:-1),O=R(l[T==1?r:o]),I=O,L=[],H=[];for(let W=T==1?r:o;W>=r&&W<=o;W+=T)if(c[W]!=null){let J=l[W],Q=R(J);L.push(I=Q),H.push(b(c[W]))}let V={stroke:i(L,H,A,_,E,y),fill:null,clip:null,band:null,gaps:null,flags:Lo},N=V.stroke,[X,$]=rf(n,s);if(a.fill!=null||X!=0){let W=V.fill=new Path2D(N),ce=a.fillTo(n,s,a.min,a.max,X),J=b(ce);_(W,I,J),_(W,O,J)}if(!a.spanGaps){let W=[];W.push(...of(l,c,r,o,T,R,t)),V.gaps=W=a.gaps(n,s,r,o,W),V.clip=Ph(W,h.ori,g,v,p,m)}return $!=0&&(V.band=$==2?[Ns(n,s,r,o,N,-1),Ns(n,s,r,o,N,1)]:Ns(n,s,r,o,N,$)),V})}function PE(i){return CE(IE,i)}function IE(i,e,t,n,s,r){let o=i.length;if(o<2)return null;let a=new Path2D;if(t(a,i[0],e[0]),o==2)n(a,i[1],e[1]);else{let l=Array(o),c=Array(o-1),h=Array(o-1),u=Array(o-1);for(let d=0;d<o-1;d++)h[d]=e[d+1]-e[d],u[d]=i[d+1]-i[d],c[d]=h[d]/u[d];l[0]=c[0];for(let d=1;d<o-1;d++)c[d]===0||c[d-1]===0||c[d-1]>0!=c[d]>0?l[d]=0:(l[d]=3*(u[d-1]+u[d])/((2*u[d]+u[d-1])/c[d-1]+(u[d]+2*u[d-1])/c[d]),isFinite(l[d])||(l[d]=0));l[o-1]=c[o-2];for(let d=0;d<o-1;d++)s(a,i[d]+u[d]/3,e[d]+l[d]*u[d]/3,i[d+1]-u[d]/3,e[d+1]-l[d+1]*u[d]/3,i[d+1],e[d+1])}return a}var Xd=new Set;function i0(){for(let i of Xd)i.syncRect(!0)}Do&&(Ir(uw,Ro,i0),Ir(dw,Ro,i0,!0),Ir(Mh,Ro,()=>{On.pxRatio=Ct}));var LE=V0(),DE=z0();function s0(i,e,t,n){return(n?[i[0],i[1]].concat(i.slice(2)):[i[0]].concat(i.slice(1))).map((r,o)=>qd(r,o,e,t))}function NE(i,e){return i.map((t,n)=>n==0?{}:_n({},e,t))}function qd(i,e,t,n){return _n({},e==0?t:n,i)}function G0(i,e,t){return e==null?Po:[e,t]}var FE=G0;function UE(i,e,t){return e==null?Po:wh(e,t,Jd,!0)}function W0(i,e,t,n){return e==null?Po:Ah(e,t,i.scales[n].log,!1)}var OE=W0;function X0(i,e,t,n){return e==null?Po:Kd(e,t,i.scales[n].log,!1)}var BE=X0;function kE(i,e,t,n,s){let r=jn(Ug(i),Ug(e)),o=e-i,a=Wi(s/n*o,t);do{let l=t[a],c=n*l/o;if(c>=s&&r+(l<5?ar.get(l):0)<=17)return[l,c]}while(++a<t.length);return[0,0]}function r0(i){let e,t;return i=i.replace(/(\d+)px/,(n,s)=>(e=Mn((t=+s)*Ct))+"px"),[i,e,t]}function zE(i){i.show&&[i.font,i.labelFont].forEach(e=>{let t=Vt(e[2]*Ct,1);e[0]=e[0].replace(/[0-9.]+px/,t+"px"),e[1]=t})}function On(i,e,t){let n={mode:At(i.mode,1)},s=n.mode;function r(x,M,P,D){let G=M.valToPct(x);return D+P*(M.dir==-1?1-G:G)}function o(x,M,P,D){let G=M.valToPct(x);return D+P*(M.dir==-1?G:1-G)}function a(x,M,P,D){return M.ori==0?r(x,M,P,D):o(x,M,P,D)}n.valToPosH=r,n.valToPosV=o;let l=!1;n.status=0;let c=n.root=Ii(YM);if(i.id!=null&&(c.id=i.id),Si(c,i.class),i.title){let x=Ii(KM,c);x.textContent=i.title}let h=Gi("canvas"),u=n.ctx=h.getContext("2d"),d=Ii(JM,c);Ir("click",d,x=>{x.target===g&&(qt!=zr||jt!=Hr)&&Dn.click(n,x)},!0);let f=n.under=Ii(jM,d);d.appendChild(h);let g=n.over=Ii(QM,d);i=Io(i);let v=+At(i.pxAlign,1),p=t0(v);(i.plugins||[]).forEach(x=>{x.opts&&(i=x.opts(n,i)||i)});let m=i.ms||.001,y=n.series=s==1?s0(i.series||[],$g,Qg,!1):NE(i.series||[null],jg),R=n.axes=s0(i.axes||[],Yg,Kg,!0),b=n.scales={},A=n.bands=i.bands||[];A.forEach(x=>{x.fill=St(x.fill||null),x.dir=At(x.dir,-1)});let E=s==2?y[1].facets[0].scale:y[0].scale,_={axes:ps,series:mt},T=(i.drawOrder||["axes","series"]).map(x=>_[x]);function O(x){let M=x.distr==3?P=>Ds(P>0?P:x.clamp(n,P,x.min,x.max,x.key)):x.distr==4?P=>Dd(P,x.asinh):x.distr==100?P=>x.fwd(P):P=>P;return P=>{let D=M(P),{_min:G,_max:K}=x,ae=K-G;return(D-G)/ae}}function I(x){let M=b[x];if(M==null){let P=(i.scales||Va)[x]||Va;if(P.from!=null){I(P.from);let D=_n({},b[P.from],P,{key:x});D.valToPct=O(D),b[x]=D}else{M=b[x]=_n({},x==E?D0:SE,P),M.key=x;let D=M.time,G=M.range,K=or(G);if((x!=E||s==2&&!D)&&(K&&(G[0]==null||G[1]==null)&&(G={min:G[0]==null?Dg:{mode:1,hard:G[0],soft:G[0]},max:G[1]==null?Dg:{mode:1,hard:G[1],soft:G[1]}},K=!1),!K&&Ch(G))){let ae=G;G=(fe,ye,De)=>ye==null?Po:wh(ye,De,ae)}M.range=St(G||(D?FE:x==E?M.distr==3?OE:M.distr==4?BE:G0:M.distr==3?W0:M.distr==4?X0:UE)),M.auto=St(K?!1:M.auto),M.clamp=St(M.clamp||bE),M._min=M._max=null,M.valToPct=O(M)}}}I("x"),I("y"),s==1&&y.forEach(x=>{I(x.scale)}),R.forEach(x=>{I(x.scale)});for(let x in i.scales)I(x);let L=b[E],H=L.distr,V,N;L.ori==0?(Si(c,$M),V=r,N=o):(Si(c,ZM),V=o,N=r);let X={};for(let x in b){let M=b[x];(M.min!=null||M.max!=null)&&(X[x]={min:M.min,max:M.max},M.min=M.max=null)}let $=i.tzDate||(x=>new Date(Mn(x/m))),W=i.fmtDate||ef,ce=m==1?$w($):Jw($),J=Wg($,Gg(m==1?Yw:Kw,W)),Q=qg($,Xg(Qw,W)),se=[],de=n.legend=_n({},nE,i.legend),ue=n.cursor=_n({},lE,{drag:{y:s==2}},i.cursor),ee=de.show,me=ue.show,_e=de.markers;de.idxs=se,_e.width=St(_e.width),_e.dash=St(_e.dash),_e.stroke=St(_e.stroke),_e.fill=St(_e.fill);let Ae,Se,Ge,st=[],He=[],ft,ct=!1,tt={};if(de.live){let x=y[1]?y[1].values:null;ct=x!=null,ft=ct?x(n,1,0):{_:0};for(let M in ft)tt[M]=$d}if(ee)if(Ae=Gi("table",rw,c),Ge=Gi("tbody",null,Ae),de.mount(n,Ae),ct){Se=Gi("thead",null,Ae,Ge);let x=Gi("tr",null,Se);Gi("th",null,x);for(var Jt in ft)Gi("th",yg,x).textContent=Jt}else Si(Ae,aw),de.live&&Si(Ae,ow);let Gt={show:!0},un={show:!1};function Ut(x,M){if(M==0&&(ct||!de.live||s==2))return Po;let P=[],D=Gi("tr",lw,Ge,Ge.childNodes[M]);Si(D,x.class),x.show||Si(D,Pr);let G=Gi("th",null,D);if(_e.show){let fe=Ii(cw,G);if(M>0){let ye=_e.width(n,M);ye&&(fe.style.border=ye+"px "+_e.dash(n,M)+" "+_e.stroke(n,M)),fe.style.background=_e.fill(n,M)}}let K=Ii(yg,G);x.label instanceof HTMLElement?K.appendChild(x.label):K.textContent=x.label,M>0&&(_e.show||(K.style.color=x.width>0?_e.stroke(n,M):_e.fill(n,M)),wt("click",G,fe=>{if(ue._lock)return;Ke(fe);let ye=y.indexOf(x);if((fe.ctrlKey||fe.metaKey)!=de.isolate){let De=y.some((Ne,Ue)=>Ue>0&&Ue!=ye&&Ne.show);y.forEach((Ne,Ue)=>{Ue>0&&Ki(Ue,De?Ue==ye?Gt:un:Gt,!0,gn.setSeries)})}else Ki(ye,{show:!x.show},!0,gn.setSeries)},!1),Je&&wt(wg,G,fe=>{ue._lock||(Ke(fe),Ki(y.indexOf(x),Gr,!0,gn.setSeries))},!1));for(var ae in ft){let fe=Gi("td",hw,D);fe.textContent="--",P.push(fe)}return[D,P]}let En=new Map;function wt(x,M,P,D=!0){let G=En.get(M)||{},K=ue.bind[x](n,M,P,D);K&&(Ir(x,M,G[x]=K),En.set(M,G))}function xn(x,M,P){let D=En.get(M)||{};for(let G in D)(x==null||G==x)&&(zd(G,M,D[G]),delete D[G]);x==null&&En.delete(M)}let tn=0,dn=0,U=0,Ce=0,Ye=0,rt=0,Me=Ye,kt=rt,ze=U,Xe=Ce,C=0,S=0,q=0,he=0;n.bbox={};let oe=!1,ve=!1,xe=!1,te=!1,ie=!1,pe=!1;function F(x,M,P){(P||x!=n.width||M!=n.height)&&re(x,M),ht(!1),xe=!0,ve=!0,Bn()}function re(x,M){n.width=tn=U=x,n.height=dn=Ce=M,Ye=rt=0,be(),Ve();let P=n.bbox;C=P.left=Rr(Ye*Ct,.5),S=P.top=Rr(rt*Ct,.5),q=P.width=Rr(U*Ct,.5),he=P.height=Rr(Ce*Ct,.5)}let ne=3;function we(){let x=!1,M=0;for(;!x;){M++;let P=Or(M),D=Zi(M);x=M==ne||P&&D,x||(re(n.width,n.height),ve=!0)}}function ge({width:x,height:M}){F(x,M)}n.setSize=ge;function be(){let x=!1,M=!1,P=!1,D=!1;R.forEach((G,K)=>{if(G.show&&G._show){let{side:ae,_size:fe}=G,ye=ae%2,De=G.label!=null?G.labelSize:0,Ne=fe+De;Ne>0&&(ye?(U-=Ne,ae==3?(Ye+=Ne,D=!0):P=!0):(Ce-=Ne,ae==0?(rt+=Ne,x=!0):M=!0))}}),Yi[0]=x,Yi[1]=P,Yi[2]=M,Yi[3]=D,U-=Di[1]+Di[3],Ye+=Di[3],Ce-=Di[2]+Di[0],rt+=Di[0]}function Ve(){let x=Ye+U,M=rt+Ce,P=Ye,D=rt;function G(K,ae){switch(K){case 1:return x+=ae,x-ae;case 2:return M+=ae,M-ae;case 3:return P-=ae,P+ae;case 0:return D-=ae,D+ae}}R.forEach((K,ae)=>{if(K.show&&K._show){let fe=K.side;K._pos=G(fe,K._size),K.label!=null&&(K._lpos=G(fe,K.labelSize))}})}if(ue.dataIdx==null){let x=ue.hover,M=x.skip=new Set(x.skip??[]);M.add(void 0);let P=x.prox=St(x.prox),D=x.bias??=0;ue.dataIdx=(G,K,ae,fe)=>{if(K==0)return ae;let ye=ae,De=P(G,K,ae,fe)??Ht,Ne=De>=0&&De<Ht,Ue=L.ori==0?U:Ce,nt=ue.left,Rt=e[0],Et=e[K];if(M.has(Et[ae])){ye=null;let _t=null,Ze=null,We;if(D==0||D==-1)for(We=ae;_t==null&&We-- >0;)M.has(Et[We])||(_t=We);if(D==0||D==1)for(We=ae;Ze==null&&We++<Et.length;)M.has(Et[We])||(Ze=We);if(_t!=null||Ze!=null)if(Ne){let $t=_t==null?-1/0:V(Rt[_t],L,Ue,0),rn=Ze==null?1/0:V(Rt[Ze],L,Ue,0),Cn=nt-$t,Ot=rn-nt;Cn<=Ot?Cn<=De&&(ye=_t):Ot<=De&&(ye=Ze)}else ye=Ze==null?_t:_t==null?Ze:ae-_t<=Ze-ae?_t:Ze}else Ne&&wn(nt-V(Rt[ae],L,Ue,0))>De&&(ye=null);return ye}}let Ke=x=>{ue.event=x};ue.idxs=se,ue._lock=!1;let le=ue.points;le.show=St(le.show),le.size=St(le.size),le.stroke=St(le.stroke),le.width=St(le.width),le.fill=St(le.fill);let Oe=n.focus=_n({},i.focus||{alpha:.3},ue.focus),Je=Oe.prox>=0,Re=Je&&le.one,ot=[],Xt=[],Xn=[];function Oo(x,M){let P=le.show(n,M);if(P instanceof HTMLElement)return Si(P,sw),Si(P,x.class),hs(P,-10,-10,U,Ce),g.insertBefore(P,ot[M]),P}function Nr(x,M){if(s==1||M>0){let P=s==1&&b[x.scale].time,D=x.value;x.value=P?kg(D)?qg($,Xg(D,W)):D||Q:D||_E,x.label=x.label||(P?hE:cE)}if(Re||M>0){x.width=x.width==null?1:x.width,x.paths=x.paths||LE||Sw,x.fillTo=St(x.fillTo||ME),x.pxAlign=+At(x.pxAlign,v),x.pxRound=t0(x.pxAlign),x.stroke=St(x.stroke||null),x.fill=St(x.fill||null),x._stroke=x._fill=x._paths=x._focus=null;let P=xE(jn(1,x.width),1),D=x.points=_n({},{size:P,width:jn(1,P*.2),stroke:x.stroke,space:P*2,paths:DE,_stroke:null,_fill:null},x.points);D.show=St(D.show),D.filter=St(D.filter),D.fill=St(D.fill),D.stroke=St(D.stroke),D.paths=St(D.paths),D.pxAlign=x.pxAlign}if(ee){let P=Ut(x,M);st.splice(M,0,P[0]),He.splice(M,0,P[1]),de.values.push(null)}if(me){se.splice(M,0,null);let P=null;Re?M==0&&(P=Oo(x,M)):M>0&&(P=Oo(x,M)),ot.splice(M,0,P),Xt.splice(M,0,0),Xn.splice(M,0,0)}Rn("addSeries",M)}function Wh(x,M){M=M??y.length,x=s==1?qd(x,M,$g,Qg):qd(x,M,{},jg),y.splice(M,0,x),Nr(y[M],M)}n.addSeries=Wh;function Xa(x){if(y.splice(x,1),ee){de.values.splice(x,1),He.splice(x,1);let M=st.splice(x,1)[0];xn(null,M.firstChild),M.remove()}me&&(se.splice(x,1),ot.splice(x,1)[0].remove(),Xt.splice(x,1),Xn.splice(x,1)),Rn("delSeries",x)}n.delSeries=Xa;let Yi=[!1,!1,!1,!1];function us(x,M){if(x._show=x.show,x.show){let P=x.side%2,D=b[x.scale];D==null&&(x.scale=P?y[1].scale:E,D=b[x.scale]);let G=D.time;x.size=St(x.size),x.space=St(x.space),x.rotate=St(x.rotate),or(x.incrs)&&x.incrs.forEach(ae=>{!ar.has(ae)&&ar.set(ae,p0(ae))}),x.incrs=St(x.incrs||(D.distr==2?Ww:G?m==1?qw:Zw:Cr)),x.splits=St(x.splits||(G&&D.distr==1?ce:D.distr==3?Vd:D.distr==4?fE:dE)),x.stroke=St(x.stroke),x.grid.stroke=St(x.grid.stroke),x.ticks.stroke=St(x.ticks.stroke),x.border.stroke=St(x.border.stroke);let K=x.values;x.values=or(K)&&!or(K[0])?St(K):G?or(K)?Wg($,Gg(K,W)):kg(K)?jw($,K):K||J:K||uE,x.filter=St(x.filter||(D.distr>=3&&D.log==10?gE:D.distr==3&&D.log==2?vE:d0)),x.font=r0(x.font),x.labelFont=r0(x.labelFont),x._size=x.size(n,null,M,0),x._space=x._rotate=x._incrs=x._found=x._splits=x._values=null,x._size>0&&(Yi[M]=!0,x._el=Ii(ew,d))}}function ds(x,M,P,D){let[G,K,ae,fe]=P,ye=M%2,De=0;return ye==0&&(fe||K)&&(De=M==0&&!G||M==2&&!ae?Mn(Yg.size/3):0),ye==1&&(G||ae)&&(De=M==1&&!K||M==3&&!fe?Mn(Kg.size/2):0),De}let Bo=n.padding=(i.padding||[ds,ds,ds,ds]).map(x=>St(At(x,ds))),Di=n._padding=Bo.map((x,M)=>x(n,M,Yi,0)),nn,cn=null,hn=null,$i=s==1?y[0].idxs:null,oi=null,Fs=!1;function ko(x,M){if(e=x??[],n.data=n._data=e,s==2){nn=0;for(let P=1;P<y.length;P++)nn+=e[P][0].length}else{e.length==0&&(n.data=n._data=e=[[]]),oi=e[0],nn=oi.length;let P=e;if(H==2){P=e.slice();let D=P[0]=Array(nn);for(let G=0;G<nn;G++)D[G]=G}n._data=e=P}if(ht(!0),Rn("setData"),H==2&&(xe=!0),M!==!1){let P=L;P.auto(n,Fs)?zo():Bs(E,P.min,P.max),te=te||ue.left>=0,pe=!0,Bn()}}n.setData=ko;function zo(){Fs=!0;let x,M;s==1&&(nn>0?(cn=$i[0]=0,hn=$i[1]=nn-1,x=e[0][cn],M=e[0][hn],H==2?(x=cn,M=hn):x==M&&(H==3?[x,M]=Ah(x,x,L.log,!1):H==4?[x,M]=Kd(x,x,L.log,!1):L.time?M=x+Mn(86400/m):[x,M]=wh(x,M,Jd,!0))):(cn=$i[0]=x=null,hn=$i[1]=M=null)),Bs(E,x,M)}let Fr,Us,Ur,w,z,j,Y,Z,Ee,Pe;function Te(x,M,P,D,G,K){x??=Sg,P??=Qd,D??="butt",G??=Sg,K??="round",x!=Fr&&(u.strokeStyle=Fr=x),G!=Us&&(u.fillStyle=Us=G),M!=Ur&&(u.lineWidth=Ur=M),K!=z&&(u.lineJoin=z=K),D!=j&&(u.lineCap=j=D),P!=w&&u.setLineDash(w=P)}function Ie(x,M,P,D){M!=Us&&(u.fillStyle=Us=M),x!=Y&&(u.font=Y=x),P!=Z&&(u.textAlign=Z=P),D!=Ee&&(u.textBaseline=Ee=D)}function ke(x,M,P,D,G=0){if(D.length>0&&x.auto(n,Fs)&&(M==null||M.min==null)){let K=At(cn,0),ae=At(hn,D.length-1),fe=P.min==null?gw(D,K,ae,G,x.distr==3):[P.min,P.max];x.min=Xi(x.min,P.min=fe[0]),x.max=jn(x.max,P.max=fe[1])}}let je={min:null,max:null};function pt(){for(let D in b){let G=b[D];X[D]==null&&(G.min==null||X[E]!=null&&G.auto(n,Fs))&&(X[D]=je)}for(let D in b){let G=b[D];X[D]==null&&G.from!=null&&X[G.from]!=null&&(X[D]=je)}X[E]!=null&&ht(!0);let x={};for(let D in X){let G=X[D];if(G!=null){let K=x[D]=Io(b[D],Ew);if(G.min!=null)_n(K,G);else if(D!=E||s==2)if(nn==0&&K.from==null){let ae=K.range(n,null,null,D);K.min=ae[0],K.max=ae[1]}else K.min=Ht,K.max=-Ht}}if(nn>0){y.forEach((D,G)=>{if(s==1){let K=D.scale,ae=X[K];if(ae==null)return;let fe=x[K];if(G==0){let ye=fe.range(n,fe.min,fe.max,K);fe.min=ye[0],fe.max=ye[1],cn=Wi(fe.min,e[0]),hn=Wi(fe.max,e[0]),hn-cn>1&&(e[0][cn]<fe.min&&cn++,e[0][hn]>fe.max&&hn--),D.min=oi[cn],D.max=oi[hn]}else D.show&&D.auto&&ke(fe,ae,D,e[G],D.sorted);D.idxs[0]=cn,D.idxs[1]=hn}else if(G>0&&D.show&&D.auto){let[K,ae]=D.facets,fe=K.scale,ye=ae.scale,[De,Ne]=e[G],Ue=x[fe],nt=x[ye];Ue!=null&&ke(Ue,X[fe],K,De,K.sorted),nt!=null&&ke(nt,X[ye],ae,Ne,ae.sorted),D.min=ae.min,D.max=ae.max}});for(let D in x){let G=x[D],K=X[D];if(G.from==null&&(K==null||K.min==null)){let ae=G.range(n,G.min==Ht?null:G.min,G.max==-Ht?null:G.max,D);G.min=ae[0],G.max=ae[1]}}}for(let D in x){let G=x[D];if(G.from!=null){let K=x[G.from];if(K.min==null)G.min=G.max=null;else{let ae=G.range(n,K.min,K.max,D);G.min=ae[0],G.max=ae[1]}}}let M={},P=!1;for(let D in x){let G=x[D],K=b[D];if(K.min!=G.min||K.max!=G.max){K.min=G.min,K.max=G.max;let ae=K.distr;K._min=ae==3?Ds(K.min):ae==4?Dd(K.min,K.asinh):ae==100?K.fwd(K.min):K.min,K._max=ae==3?Ds(K.max):ae==4?Dd(K.max,K.asinh):ae==100?K.fwd(K.max):K.max,M[D]=P=!0}}if(P){y.forEach((D,G)=>{s==2?G>0&&M.y&&(D._paths=null):M[D.scale]&&(D._paths=null)});for(let D in M)xe=!0,Rn("setScale",D);me&&ue.left>=0&&(te=pe=!0)}for(let D in X)X[D]=null}function Be(x){let M=Hd(cn-1,0,nn-1),P=Hd(hn+1,0,nn-1);for(;x[M]==null&&M>0;)M--;for(;x[P]==null&&P<nn-1;)P++;return[M,P]}function mt(){if(nn>0){let x=y.some(M=>M._focus)&&Pe!=Oe.alpha;x&&(u.globalAlpha=Pe=Oe.alpha),y.forEach((M,P)=>{if(P>0&&M.show&&(Qt(P,!1),Qt(P,!0),M._paths==null)){let D=Pe;Pe!=M.alpha&&(u.globalAlpha=Pe=M.alpha);let G=s==2?[0,e[P][0].length-1]:Be(e[P]);M._paths=M.paths(n,P,G[0],G[1]),Pe!=D&&(u.globalAlpha=Pe=D)}}),y.forEach((M,P)=>{if(P>0&&M.show){let D=Pe;Pe!=M.alpha&&(u.globalAlpha=Pe=M.alpha),M._paths!=null&&Lt(P,!1);{let G=M._paths!=null?M._paths.gaps:null,K=M.points.show(n,P,cn,hn,G),ae=M.points.filter(n,P,K,G);(K||ae)&&(M.points._paths=M.points.paths(n,P,cn,hn,ae),Lt(P,!0))}Pe!=D&&(u.globalAlpha=Pe=D),Rn("drawSeries",P)}}),x&&(u.globalAlpha=Pe=1)}}function Qt(x,M){let P=M?y[x].points:y[x];P._stroke=P.stroke(n,x),P._fill=P.fill(n,x)}function Lt(x,M){let P=M?y[x].points:y[x],{stroke:D,fill:G,clip:K,flags:ae,_stroke:fe=P._stroke,_fill:ye=P._fill,_width:De=P.width}=P._paths;De=Vt(De*Ct,3);let Ne=null,Ue=De%2/2;M&&ye==null&&(ye=De>0?"#fff":fe);let nt=P.pxAlign==1&&Ue>0;if(nt&&u.translate(Ue,Ue),!M){let Rt=C-De/2,Et=S-De/2,_t=q+De,Ze=he+De;Ne=new Path2D,Ne.rect(Rt,Et,_t,Ze)}M?Fe(fe,De,P.dash,P.cap,ye,D,G,ae,K):Dt(x,fe,De,P.dash,P.cap,ye,D,G,ae,Ne,K),nt&&u.translate(-Ue,-Ue)}function Dt(x,M,P,D,G,K,ae,fe,ye,De,Ne){let Ue=!1;ye!=0&&A.forEach((nt,Rt)=>{if(nt.series[0]==x){let Et=y[nt.series[1]],_t=e[nt.series[1]],Ze=(Et._paths||Va).band;or(Ze)&&(Ze=nt.dir==1?Ze[0]:Ze[1]);let We,$t=null;Et.show&&Ze&&_w(_t,cn,hn)?($t=nt.fill(n,Rt)||K,We=Et._paths.clip):Ze=null,Fe(M,P,D,G,$t,ae,fe,ye,De,Ne,We,Ze),Ue=!0}}),Ue||Fe(M,P,D,G,K,ae,fe,ye,De,Ne)}let yn=Lo|Wd;function Fe(x,M,P,D,G,K,ae,fe,ye,De,Ne,Ue){Te(x,M,P,D,G),(ye||De||Ue)&&(u.save(),ye&&u.clip(ye),De&&u.clip(De)),Ue?(fe&yn)==yn?(u.clip(Ue),Ne&&u.clip(Ne),bt(G,ae),fn(x,K,M)):fe&Wd?(bt(G,ae),u.clip(Ue),fn(x,K,M)):fe&Lo&&(u.save(),u.clip(Ue),Ne&&u.clip(Ne),bt(G,ae),u.restore(),fn(x,K,M)):(bt(G,ae),fn(x,K,M)),(ye||De||Ue)&&u.restore()}function fn(x,M,P){P>0&&(M instanceof Map?M.forEach((D,G)=>{u.strokeStyle=Fr=G,u.stroke(D)}):M!=null&&x&&u.stroke(M))}function bt(x,M){M instanceof Map?M.forEach((P,D)=>{u.fillStyle=Us=D,u.fill(P)}):M!=null&&x&&u.fill(M)}function fs(x,M,P,D){let G=R[x],K;if(D<=0)K=[0,0];else{let ae=G._space=G.space(n,x,M,P,D),fe=G._incrs=G.incrs(n,x,M,P,D,ae);K=kE(M,P,fe,D,ae)}return G._found=K}function pn(x,M,P,D,G,K,ae,fe,ye,De){let Ne=ae%2/2;v==1&&u.translate(Ne,Ne),Te(fe,ae,ye,De,fe),u.beginPath();let Ue,nt,Rt,Et,_t=G+(D==0||D==3?-K:K);P==0?(nt=G,Et=_t):(Ue=G,Rt=_t);for(let Ze=0;Ze<x.length;Ze++)M[Ze]!=null&&(P==0?Ue=Rt=x[Ze]:nt=Et=x[Ze],u.moveTo(Ue,nt),u.lineTo(Rt,Et));u.stroke(),v==1&&u.translate(-Ne,-Ne)}function Or(x){let M=!0;return R.forEach((P,D)=>{if(!P.show)return;let G=b[P.scale];if(G.min==null){P._show&&(M=!1,P._show=!1,ht(!1));return}else P._show||(M=!1,P._show=!0,ht(!1));let K=P.side,ae=K%2,{min:fe,max:ye}=G,[De,Ne]=fs(D,fe,ye,ae==0?U:Ce);if(Ne==0)return;let Ue=G.distr==2,nt=P._splits=P.splits(n,D,fe,ye,De,Ne,Ue),Rt=G.distr==2?nt.map(We=>oi[We]):nt,Et=G.distr==2?oi[nt[1]]-oi[nt[0]]:De,_t=P._values=P.values(n,P.filter(n,Rt,D,Ne,Et),D,Ne,Et);P._rotate=K==2?P.rotate(n,_t,D,Ne):0;let Ze=P._size;P._size=Li(P.size(n,_t,D,x)),Ze!=null&&P._size!=Ze&&(M=!1)}),M}function Zi(x){let M=!0;return Bo.forEach((P,D)=>{let G=P(n,D,Yi,x);G!=Di[D]&&(M=!1),Di[D]=G}),M}function ps(){for(let x=0;x<R.length;x++){let M=R[x];if(!M.show||!M._show)continue;let P=M.side,D=P%2,G,K,ae=M.stroke(n,x),fe=P==0||P==3?-1:1,[ye,De]=M._found;if(M.label!=null){let $n=M.labelGap*fe,ci=Mn((M._lpos+$n)*Ct);Ie(M.labelFont[0],ae,"center",P==2?"top":bg),u.save(),D==1?(G=K=0,u.translate(ci,Mn(S+he/2)),u.rotate((P==3?-Sh:Sh)/2)):(G=Mn(C+q/2),K=ci);let hr=h0(M.label)?M.label(n,x,ye,De):M.label;u.fillText(hr,G,K),u.restore()}if(De==0)continue;let Ne=b[M.scale],Ue=D==0?q:he,nt=D==0?C:S,Rt=M._splits,Et=Ne.distr==2?Rt.map($n=>oi[$n]):Rt,_t=Ne.distr==2?oi[Rt[1]]-oi[Rt[0]]:ye,Ze=M.ticks,We=M.border,$t=Ze.show?Ze.size:0,rn=Mn($t*Ct),Cn=Mn((M.alignTo==2?M._size-$t-M.gap:M.gap)*Ct),Ot=M._rotate*-Sh/180,on=p(M._pos*Ct),ai=(rn+Cn)*fe,Yn=on+ai;K=D==0?Yn:0,G=D==1?Yn:0;let Ei=M.font[0],Ni=M.align==1?To:M.align==2?Pd:Ot>0?To:Ot<0?Pd:D==0?"center":P==3?Pd:To,ji=Ot||D==1?"middle":P==2?"top":bg;Ie(Ei,ae,Ni,ji);let li=M.font[1]*M.lineGap,Ti=Rt.map($n=>p(a($n,Ne,Ue,nt))),Fi=M._values;for(let $n=0;$n<Fi.length;$n++){let ci=Fi[$n];if(ci!=null){D==0?G=Ti[$n]:K=Ti[$n],ci=""+ci;let hr=ci.indexOf(`
`)==-1?[ci]:ci.split(/\n/gm);for(let Zn=0;Zn<hr.length;Zn++){let Bf=hr[Zn];Ot?(u.save(),u.translate(G,K+Zn*li),u.rotate(Ot),u.fillText(Bf,0,0),u.restore()):u.fillText(Bf,G,K+Zn*li)}}}Ze.show&&pn(Ti,Ze.filter(n,Et,x,De,_t),D,P,on,rn,Vt(Ze.width*Ct,3),Ze.stroke(n,x),Ze.dash,Ze.cap);let Qi=M.grid;Qi.show&&pn(Ti,Qi.filter(n,Et,x,De,_t),D,D==0?2:1,D==0?S:C,D==0?he:q,Vt(Qi.width*Ct,3),Qi.stroke(n,x),Qi.dash,Qi.cap),We.show&&pn([on],[1],D==0?1:0,D==0?1:2,D==1?S:C,D==1?he:q,Vt(We.width*Ct,3),We.stroke(n,x),We.dash,We.cap)}Rn("drawAxes")}function ht(x){y.forEach((M,P)=>{P>0&&(M._paths=null,x&&(s==1?(M.min=null,M.max=null):M.facets.forEach(D=>{D.min=null,D.max=null})))})}let sn=!1,qn=!1,Nt=[];function mn(){qn=!1;for(let x=0;x<Nt.length;x++)Rn(...Nt[x]);Nt.length=0}function Bn(){sn||(Lw(yf),sn=!0)}function qa(x,M=!1){sn=!0,qn=M,x(n),yf(),M&&Nt.length>0&&queueMicrotask(mn)}n.batch=qa;function yf(){if(oe&&(pt(),oe=!1),xe&&(we(),xe=!1),ve){if(Kt(f,To,Ye),Kt(f,"top",rt),Kt(f,Ba,U),Kt(f,ka,Ce),Kt(g,To,Ye),Kt(g,"top",rt),Kt(g,Ba,U),Kt(g,ka,Ce),Kt(d,Ba,tn),Kt(d,ka,dn),h.width=Mn(tn*Ct),h.height=Mn(dn*Ct),R.forEach(({_el:x,_show:M,_size:P,_pos:D,side:G})=>{if(x!=null)if(M){let K=G===3||G===0?P:0,ae=G%2==1;Kt(x,ae?"left":"top",D-K),Kt(x,ae?"width":"height",P),Kt(x,ae?"top":"left",ae?rt:Ye),Kt(x,ae?"height":"width",ae?Ce:U),kd(x,Pr)}else Si(x,Pr)}),Fr=Us=Ur=z=j=Y=Z=Ee=w=null,Pe=1,Go(!0),Ye!=Me||rt!=kt||U!=ze||Ce!=Xe){ht(!1);let x=U/ze,M=Ce/Xe;if(me&&!te&&ue.left>=0){ue.left*=x,ue.top*=M,Br&&hs(Br,Mn(ue.left),0,U,Ce),kr&&hs(kr,0,Mn(ue.top),U,Ce);for(let P=0;P<ot.length;P++){let D=ot[P];D!=null&&(Xt[P]*=x,Xn[P]*=M,hs(D,Li(Xt[P]),Li(Xn[P]),U,Ce))}}if(Yt.show&&!ie&&Yt.left>=0&&Yt.width>0){Yt.left*=x,Yt.width*=x,Yt.top*=M,Yt.height*=M;for(let P in Kh)Kt(Vr,P,Yt[P])}Me=Ye,kt=rt,ze=U,Xe=Ce}Rn("setSize"),ve=!1}tn>0&&dn>0&&(u.clearRect(0,0,h.width,h.height),Rn("drawClear"),T.forEach(x=>x()),Rn("draw")),Yt.show&&ie&&(Ya(Yt),ie=!1),me&&te&&(cr(null,!0,!1),te=!1),de.show&&de.live&&pe&&($h(),pe=!1),l||(l=!0,n.status=1,Rn("ready")),Fs=!1,sn=!1}n.redraw=(x,M)=>{xe=M||!1,x!==!1?Bs(E,L.min,L.max):Bn()};function Xh(x,M){let P=b[x];if(P.from==null){if(nn==0){let D=P.range(n,M.min,M.max,x);M.min=D[0],M.max=D[1]}if(M.min>M.max){let D=M.min;M.min=M.max,M.max=D}if(nn>1&&M.min!=null&&M.max!=null&&M.max-M.min<1e-16)return;x==E&&P.distr==2&&nn>0&&(M.min=Wi(M.min,e[0]),M.max=Wi(M.max,e[0]),M.min==M.max&&M.max++),X[x]=M,oe=!0,Bn()}}n.setScale=Xh;let qh,Yh,Br,kr,bf,Sf,zr,Hr,Mf,wf,qt,jt,Os=!1,Dn=ue.drag,Tn=Dn.x,An=Dn.y;me&&(ue.x&&(qh=Ii(nw,g)),ue.y&&(Yh=Ii(iw,g)),L.ori==0?(Br=qh,kr=Yh):(Br=Yh,kr=qh),qt=ue.left,jt=ue.top);let Yt=n.select=_n({show:!0,over:!0,left:0,width:0,top:0,height:0},i.select),Vr=Yt.show?Ii(tw,Yt.over?g:f):null;function Ya(x,M){if(Yt.show){for(let P in x)Yt[P]=x[P],P in Kh&&Kt(Vr,P,x[P]);M!==!1&&Rn("setSelect")}}n.setSelect=Ya;function pv(x){if(y[x].show)ee&&kd(st[x],Pr);else if(ee&&Si(st[x],Pr),me){let P=Re?ot[0]:ot[x];P!=null&&hs(P,-10,-10,U,Ce)}}function Bs(x,M,P){Xh(x,{min:M,max:P})}function Ki(x,M,P,D){M.focus!=null&&xv(x),M.show!=null&&y.forEach((G,K)=>{K>0&&(x==K||x==null)&&(G.show=M.show,pv(K),s==2?(Bs(G.facets[0].scale,null,null),Bs(G.facets[1].scale,null,null)):Bs(G.scale,null,null),Bn())}),P!==!1&&Rn("setSeries",x,M),D&&Wo("setSeries",n,x,M)}n.setSeries=Ki;function mv(x,M){_n(A[x],M)}function gv(x,M){x.fill=St(x.fill||null),x.dir=At(x.dir,-1),M=M??A.length,A.splice(M,0,x)}function vv(x){x==null?A.length=0:A.splice(x,1)}n.addBand=gv,n.setBand=mv,n.delBand=vv;function _v(x,M){y[x].alpha=M,me&&ot[x]!=null&&(ot[x].style.opacity=M),ee&&st[x]&&(st[x].style.opacity=M)}let ms,ks,lr,Gr={focus:!0};function xv(x){if(x!=lr){let M=x==null,P=Oe.alpha!=1;y.forEach((D,G)=>{if(s==1||G>0){let K=M||G==0||G==x;D._focus=M?null:K,P&&_v(G,K?1:Oe.alpha)}}),lr=x,P&&Bn()}}ee&&Je&&wt(Eg,Ae,x=>{ue._lock||(Ke(x),lr!=null&&Ki(null,Gr,!0,gn.setSeries))});function Ji(x,M,P){let D=b[M];P&&(x=x/Ct-(D.ori==1?rt:Ye));let G=U;D.ori==1&&(G=Ce,x=G-x),D.dir==-1&&(x=G-x);let K=D._min,ae=D._max,fe=x/G,ye=K+(ae-K)*fe,De=D.distr;return De==3?Co(10,ye):De==4?yw(ye,D.asinh):De==100?D.bwd(ye):ye}function yv(x,M){let P=Ji(x,E,M);return Wi(P,e[0],cn,hn)}n.valToIdx=x=>Wi(x,e[0]),n.posToIdx=yv,n.posToVal=Ji,n.valToPos=(x,M,P)=>b[M].ori==0?r(x,b[M],P?q:U,P?C:0):o(x,b[M],P?he:Ce,P?S:0),n.setCursor=(x,M,P)=>{qt=x.left,jt=x.top,cr(null,M,P)};function Ef(x,M){Kt(Vr,To,Yt.left=x),Kt(Vr,Ba,Yt.width=M)}function Tf(x,M){Kt(Vr,"top",Yt.top=x),Kt(Vr,ka,Yt.height=M)}let Ho=L.ori==0?Ef:Tf,Vo=L.ori==1?Ef:Tf;function bv(){if(ee&&de.live)for(let x=s==2?1:0;x<y.length;x++){if(x==0&&ct)continue;let M=de.values[x],P=0;for(let D in M)He[x][P++].firstChild.nodeValue=M[D]}}function $h(x,M){if(x!=null&&(x.idxs?x.idxs.forEach((P,D)=>{se[D]=P}):ww(x.idx)||se.fill(x.idx),de.idx=se[0]),ee&&de.live){for(let P=0;P<y.length;P++)(P>0||s==1&&!ct)&&Sv(P,se[P]);bv()}pe=!1,M!==!1&&Rn("setLegend")}n.setLegend=$h;function Sv(x,M){let P=y[x],D=x==0&&H==2?oi:e[x],G;ct?G=P.values(n,x,M)??tt:(G=P.value(n,M==null?null:D[M],x,M),G=G==null?tt:{_:G}),de.values[x]=G}function cr(x,M,P){Mf=qt,wf=jt,[qt,jt]=ue.move(n,qt,jt),ue.left=qt,ue.top=jt,me&&(Br&&hs(Br,Mn(qt),0,U,Ce),kr&&hs(kr,0,Mn(jt),U,Ce));let D,G=cn>hn;ms=Ht,ks=null;let K=L.ori==0?U:Ce,ae=L.ori==1?U:Ce;if(qt<0||nn==0||G){D=ue.idx=null;for(let fe=0;fe<y.length;fe++){let ye=ot[fe];ye!=null&&hs(ye,-10,-10,U,Ce)}Je&&Ki(null,Gr,!0,x==null&&gn.setSeries),de.live&&(se.fill(D),pe=!0)}else{let fe,ye,De;s==1&&(fe=L.ori==0?qt:jt,ye=Ji(fe,E),D=ue.idx=Wi(ye,e[0],cn,hn),De=V(e[0][D],L,K,0));let Ne=-10,Ue=-10,nt=0,Rt=0,Et=!0,_t="",Ze="";for(let We=s==2?1:0;We<y.length;We++){let $t=y[We],rn=se[We],Cn=rn==null?null:s==1?e[We][rn]:e[We][1][rn],Ot=ue.dataIdx(n,We,D,ye),on=Ot==null?null:s==1?e[We][Ot]:e[We][1][Ot];if(pe=pe||on!=Cn||Ot!=rn,se[We]=Ot,We>0&&$t.show){let ai=Ot==null?-10:Ot==D?De:V(s==1?e[0][Ot]:e[We][0][Ot],L,K,0),Yn=on==null?-10:N(on,s==1?b[$t.scale]:b[$t.facets[1].scale],ae,0);if(Je&&on!=null){let Ei=L.ori==1?qt:jt,Ni=wn(Oe.dist(n,We,Ot,Yn,Ei));if(Ni<ms){let ji=Oe.bias;if(ji!=0){let li=Ji(Ei,$t.scale),Ti=on>=0?1:-1,Fi=li>=0?1:-1;Fi==Ti&&(Fi==1?ji==1?on>=li:on<=li:ji==1?on<=li:on>=li)&&(ms=Ni,ks=We)}else ms=Ni,ks=We}}if(pe||Re){let Ei,Ni;L.ori==0?(Ei=ai,Ni=Yn):(Ei=Yn,Ni=ai);let ji,li,Ti,Fi,Qi,$n,ci=!0,hr=le.bbox;if(hr!=null){ci=!1;let Zn=hr(n,We);Ti=Zn.left,Fi=Zn.top,ji=Zn.width,li=Zn.height}else Ti=Ei,Fi=Ni,ji=li=le.size(n,We);if($n=le.fill(n,We),Qi=le.stroke(n,We),Re)We==ks&&ms<=Oe.prox&&(Ne=Ti,Ue=Fi,nt=ji,Rt=li,Et=ci,_t=$n,Ze=Qi);else{let Zn=ot[We];Zn!=null&&(Xt[We]=Ti,Xn[We]=Fi,Lg(Zn,ji,li,ci),Pg(Zn,$n,Qi),hs(Zn,Li(Ti),Li(Fi),U,Ce))}}}}if(Re){let We=Oe.prox,$t=lr==null?ms<=We:ms>We||ks!=lr;if(pe||$t){let rn=ot[0];rn!=null&&(Xt[0]=Ne,Xn[0]=Ue,Lg(rn,nt,Rt,Et),Pg(rn,_t,Ze),hs(rn,Li(Ne),Li(Ue),U,Ce))}}}if(Yt.show&&Os)if(x!=null){let[fe,ye]=gn.scales,[De,Ne]=gn.match,[Ue,nt]=x.cursor.sync.scales,Rt=x.cursor.drag;if(Tn=Rt._x,An=Rt._y,Tn||An){let{left:Et,top:_t,width:Ze,height:We}=x.select,$t=x.scales[Ue].ori,rn=x.posToVal,Cn,Ot,on,ai,Yn,Ei=fe!=null&&De(fe,Ue),Ni=ye!=null&&Ne(ye,nt);Ei&&Tn?($t==0?(Cn=Et,Ot=Ze):(Cn=_t,Ot=We),on=b[fe],ai=V(rn(Cn,Ue),on,K,0),Yn=V(rn(Cn+Ot,Ue),on,K,0),Ho(Xi(ai,Yn),wn(Yn-ai))):Ho(0,K),Ni&&An?($t==1?(Cn=Et,Ot=Ze):(Cn=_t,Ot=We),on=b[ye],ai=N(rn(Cn,nt),on,ae,0),Yn=N(rn(Cn+Ot,nt),on,ae,0),Vo(Xi(ai,Yn),wn(Yn-ai))):Vo(0,ae)}else Jh()}else{let fe=wn(Mf-bf),ye=wn(wf-Sf);if(L.ori==1){let nt=fe;fe=ye,ye=nt}Tn=Dn.x&&fe>=Dn.dist,An=Dn.y&&ye>=Dn.dist;let De=Dn.uni;De!=null?Tn&&An&&(Tn=fe>=De,An=ye>=De,!Tn&&!An&&(ye>fe?An=!0:Tn=!0)):Dn.x&&Dn.y&&(Tn||An)&&(Tn=An=!0);let Ne,Ue;Tn&&(L.ori==0?(Ne=zr,Ue=qt):(Ne=Hr,Ue=jt),Ho(Xi(Ne,Ue),wn(Ue-Ne)),An||Vo(0,ae)),An&&(L.ori==1?(Ne=zr,Ue=qt):(Ne=Hr,Ue=jt),Vo(Xi(Ne,Ue),wn(Ue-Ne)),Tn||Ho(0,K)),!Tn&&!An&&(Ho(0,0),Vo(0,0))}if(Dn._x=Tn,Dn._y=An,x==null){if(P){if(Of!=null){let[fe,ye]=gn.scales;gn.values[0]=fe!=null?Ji(L.ori==0?qt:jt,fe):null,gn.values[1]=ye!=null?Ji(L.ori==1?qt:jt,ye):null}Wo(Id,n,qt,jt,U,Ce,D)}if(Je){let fe=P&&gn.setSeries,ye=Oe.prox;lr==null?ms<=ye&&Ki(ks,Gr,!0,fe):ms>ye?Ki(null,Gr,!0,fe):ks!=lr&&Ki(ks,Gr,!0,fe)}}pe&&(de.idx=D,$h()),M!==!1&&Rn("setCursor")}let zs=null;Object.defineProperty(n,"rect",{get(){return zs==null&&Go(!1),zs}});function Go(x=!1){x?zs=null:(zs=g.getBoundingClientRect(),Rn("syncRect",zs))}function Af(x,M,P,D,G,K,ae){ue._lock||Os&&x!=null&&x.movementX==0&&x.movementY==0||(Zh(x,M,P,D,G,K,ae,!1,x!=null),x!=null?cr(null,!0,!0):cr(M,!0,!1))}function Zh(x,M,P,D,G,K,ae,fe,ye){if(zs==null&&Go(!1),Ke(x),x!=null)P=x.clientX-zs.left,D=x.clientY-zs.top;else{if(P<0||D<0){qt=-10,jt=-10;return}let[De,Ne]=gn.scales,Ue=M.cursor.sync,[nt,Rt]=Ue.values,[Et,_t]=Ue.scales,[Ze,We]=gn.match,$t=M.axes[0].side%2==1,rn=L.ori==0?U:Ce,Cn=L.ori==1?U:Ce,Ot=$t?K:G,on=$t?G:K,ai=$t?D:P,Yn=$t?P:D;if(Et!=null?P=Ze(De,Et)?a(nt,b[De],rn,0):-10:P=rn*(ai/Ot),_t!=null?D=We(Ne,_t)?a(Rt,b[Ne],Cn,0):-10:D=Cn*(Yn/on),L.ori==1){let Ei=P;P=D,D=Ei}}ye&&(M==null||M.cursor.event.type==Id)&&((P<=1||P>=U-1)&&(P=Rr(P,U)),(D<=1||D>=Ce-1)&&(D=Rr(D,Ce))),fe?(bf=P,Sf=D,[zr,Hr]=ue.move(n,P,D)):(qt=P,jt=D)}let Kh={width:0,height:0,left:0,top:0};function Jh(){Ya(Kh,!1)}let Rf,Cf,Pf,If;function Lf(x,M,P,D,G,K,ae){Os=!0,Tn=An=Dn._x=Dn._y=!1,Zh(x,M,P,D,G,K,ae,!0,!1),x!=null&&(wt(Ld,Od,Df,!1),Wo(Mg,n,zr,Hr,U,Ce,null));let{left:fe,top:ye,width:De,height:Ne}=Yt;Rf=fe,Cf=ye,Pf=De,If=Ne}function Df(x,M,P,D,G,K,ae){Os=Dn._x=Dn._y=!1,Zh(x,M,P,D,G,K,ae,!1,!0);let{left:fe,top:ye,width:De,height:Ne}=Yt,Ue=De>0||Ne>0,nt=Rf!=fe||Cf!=ye||Pf!=De||If!=Ne;if(Ue&&nt&&Ya(Yt),Dn.setScale&&Ue&&nt){let Rt=fe,Et=De,_t=ye,Ze=Ne;if(L.ori==1&&(Rt=ye,Et=Ne,_t=fe,Ze=De),Tn&&Bs(E,Ji(Rt,E),Ji(Rt+Et,E)),An)for(let We in b){let $t=b[We];We!=E&&$t.from==null&&$t.min!=Ht&&Bs(We,Ji(_t+Ze,We),Ji(_t,We))}Jh()}else ue.lock&&(ue._lock=!ue._lock,cr(M,!0,x!=null));x!=null&&(xn(Ld,Od),Wo(Ld,n,qt,jt,U,Ce,null))}function Mv(x,M,P,D,G,K,ae){if(ue._lock)return;Ke(x);let fe=Os;if(Os){let ye=!0,De=!0,Ne=10,Ue,nt;L.ori==0?(Ue=Tn,nt=An):(Ue=An,nt=Tn),Ue&&nt&&(ye=qt<=Ne||qt>=U-Ne,De=jt<=Ne||jt>=Ce-Ne),Ue&&ye&&(qt=qt<zr?0:U),nt&&De&&(jt=jt<Hr?0:Ce),cr(null,!0,!0),Os=!1}qt=-10,jt=-10,se.fill(null),cr(null,!0,!0),fe&&(Os=fe)}function Nf(x,M,P,D,G,K,ae){ue._lock||(Ke(x),zo(),Jh(),x!=null&&Wo(Tg,n,qt,jt,U,Ce,null))}function Ff(){R.forEach(zE),F(n.width,n.height,!0)}Ir(Mh,Ro,Ff);let Wr={};Wr.mousedown=Lf,Wr.mousemove=Af,Wr.mouseup=Df,Wr.dblclick=Nf,Wr.setSeries=(x,M,P,D)=>{let G=gn.match[2];P=G(n,M,P),P!=-1&&Ki(P,D,!0,!1)},me&&(wt(Mg,g,Lf),wt(Id,g,Af),wt(wg,g,x=>{Ke(x),Go(!1)}),wt(Eg,g,Mv),wt(Tg,g,Nf),Xd.add(n),n.syncRect=Go);let $a=n.hooks=i.hooks||{};function Rn(x,M,P){qn?Nt.push([x,M,P]):x in $a&&$a[x].forEach(D=>{D.call(null,n,M,P)})}(i.plugins||[]).forEach(x=>{for(let M in x.hooks)$a[M]=($a[M]||[]).concat(x.hooks[M])});let Uf=(x,M,P)=>P,gn=_n({key:null,setSeries:!1,filters:{pub:Og,sub:Og},scales:[E,y[1]?y[1].scale:null],match:[Bg,Bg,Uf],values:[null,null]},ue.sync);gn.match.length==2&&gn.match.push(Uf),ue.sync=gn;let Of=gn.key,jh=N0(Of);function Wo(x,M,P,D,G,K,ae){gn.filters.pub(x,M,P,D,G,K,ae)&&jh.pub(x,M,P,D,G,K,ae)}jh.sub(n);function wv(x,M,P,D,G,K,ae){gn.filters.sub(x,M,P,D,G,K,ae)&&Wr[x](null,M,P,D,G,K,ae)}n.pub=wv;function Ev(){jh.unsub(n),Xd.delete(n),En.clear(),zd(Mh,Ro,Ff),c.remove(),Ae?.remove(),Rn("destroy")}n.destroy=Ev;function Qh(){Rn("init",i,e),ko(e||i.data,!1),X[E]?Xh(E,X[E]):zo(),ie=Yt.show&&(Yt.width>0||Yt.height>0),te=pe=!0,F(i.width,i.height)}return y.forEach(Nr),R.forEach(us),t?t instanceof HTMLElement?(t.appendChild(c),Qh()):t(n,Qh):Qh(),n}On.assign=_n;On.fmtNum=jd;On.rangeNum=wh;On.rangeLog=Ah;On.rangeAsinh=Kd;On.orient=Dr;On.pxRatio=Ct;On.join=Iw;On.fmtDate=ef,On.tzDate=Vw;On.sync=N0;{On.addGap=wE,On.clipGaps=Ph;let i=On.paths={points:z0};i.linear=V0,i.stepped=AE,i.bars=RE,i.spline=PE}var HE={play:"M5 3.2v9.6L12.6 8z",pause:"M5.2 3.5v9M10.8 3.5v9",step:"M4 3.5v9L10 8zM12.2 3.5v9",back:"M12 3.5v9L6 8zM3.8 3.5v9",nextMark:"M3 8h6.5M7 5l3 3-3 3M13 3.5v9",lastMark:"M13 8H6.5M9 5L6 8l3 3M3 3.5v9",search:"M7 11.5a4.5 4.5 0 1 0 0-9 4.5 4.5 0 0 0 0 9zM10.4 10.4l3.4 3.4",camera:"M2.5 5h2.3l1.2-1.8h4L11.2 5h2.3v8h-11zM8 11.2a2.3 2.3 0 1 0 0-4.6 2.3 2.3 0 0 0 0 4.6z",link:"M6.7 9.3a2.6 2.6 0 0 0 3.8.2l2-2a2.7 2.7 0 0 0-3.8-3.8l-1 1M9.3 6.7a2.6 2.6 0 0 0-3.8-.2l-2 2a2.7 2.7 0 0 0 3.8 3.8l1-1",help:"M5.8 6a2.2 2.2 0 1 1 3.4 1.9c-.8.5-1.2.9-1.2 1.8M8 12.2v.3",light:"M8 10.8a2.8 2.8 0 1 0 0-5.6 2.8 2.8 0 0 0 0 5.6zM8 1.5v1.4M8 13.1v1.4M1.5 8h1.4M13.1 8h1.4M3.4 3.4l1 1M11.6 11.6l1 1M3.4 12.6l1-1M11.6 4.4l1-1",dark:"M13 9.6A5.6 5.6 0 0 1 6.4 3a5.4 5.4 0 1 0 6.6 6.6z",auto:"M8 13.5a5.5 5.5 0 1 0 0-11 5.5 5.5 0 0 0 0 11zM8 2.5v11M8 5h3.8M8 8h5.4M8 11h3.8",text:"M2.5 12.5L6 3.5l3.5 9M3.6 9.8h4.8M10.8 12.5l2-5 2 5M11.3 11h3",full:"M2.5 6V2.5H6M10 2.5h3.5V6M13.5 10v3.5H10M6 13.5H2.5V10",layers:"M8 2.5L14 6 8 9.5 2 6zM2.5 9.2L8 12.5l5.5-3.3",chart:"M2.5 2.5v11h11M4.5 10.5l3-3.5 2.3 2 3.7-5",target:"M8 12.5a4.5 4.5 0 1 0 0-9 4.5 4.5 0 0 0 0 9zM8 1.5v4M8 10.5v4M1.5 8h4M10.5 8h4",fit:"M3 5V3h2M11 3h2v2M13 11v2h-2M5 13H3v-2M8 9.5a1.5 1.5 0 1 0 0-3 1.5 1.5 0 0 0 0 3z",close:"M4 4l8 8M12 4l-8 8",plus:"M8 3.5v9M3.5 8h9",list:"M5.5 4h8M5.5 8h8M5.5 12h8M2.5 4h.2M2.5 8h.2M2.5 12h.2",slower:"M8 4L3.5 8 8 12M13 4L8.5 8 13 12",faster:"M8 4l4.5 4L8 12M3 4l4.5 4L3 12",flag:"M4 14V2.5h8L10.2 5.5 12 8.5H4"};function yt(i){let e=tu("svg",{viewBox:"0 0 16 16",class:"icon","aria-hidden":"true",focusable:"false"});return e.append(tu("path",{d:HE[i]})),e}var lf=4e3,cf=class{constructor(e){this.about=e}about;times=[];values=[];version=0;asked=!1;spacing_s=0;get last(){return this.values.at(-1)??null}at(e){let t=0,n=this.times.length;for(;t<n;){let s=t+n>>1;this.times[s]<=e?t=s+1:n=s}return t>0?this.values[t-1]:null}push(e,t){let n=Number.isFinite(t)?t:null,s=this.times.length,r=s>0?this.times[s-1]:-1/0;if(e<r)return;this.version+=1;let o=s>1?this.times[s-2]:-1/0;if(e===r||r-o<this.spacing_s){this.times[s-1]=e,this.values[s-1]=n;return}this.times.push(e),this.values.push(n),s+1>lf&&this.thin()}fill(e,t){let n=e.length>0?e[e.length-1]:-1/0,s=this.times.findIndex(o=>o>n),r=s<0?this.times.length:s;for(this.times=[...e,...this.times.slice(r)],this.values=[...t,...this.values.slice(r)],this.asked=!0,this.version+=1;this.times.length>lf;)this.thin()}thin(){let e=(n,s)=>s%2===0;this.times=this.times.filter(e),this.values=this.values.filter(e);let t=this.times.at(-1)-this.times[0];this.spacing_s=t/lf}},Nh=class{lines=new Map;known=new Tt(0);changes=0;declare(e){for(let t of e)this.lines.has(t.id)||this.lines.set(t.id,new cf(t));this.known.value=++this.changes}fill(e,t,n){this.lines.get(e)?.fill(t,n),this.known.value=++this.changes}push(e){for(let t=0;t<e.ids.length;t+=1)this.lines.get(e.ids[t])?.push(e.time,e.values[t])}find(e,t){for(let n of this.lines.values())if(n.about.name===e&&n.about.vehicle===t)return n}ofRun(){return[...this.lines.values()].filter(e=>e.about.vehicle===null)}ofVehicles(){let e=new Map;for(let{about:t}of this.lines.values())t.vehicle!==null?e.set(t.name,t.unit):t.name.endsWith("/mean")&&e.set(t.name.slice(0,-5),t.unit);return e}};var Fh=class{constructor(e){this.send=e}send;a=null;b=null;arrived_ms=0;stride_ms=33;drawn=!0;jumped=!1;toThank=[];packets=[];get frame(){return this.b}get busy(){return!this.drawn}take(e,t){let n=t-this.arrived_ms;n>1e3?this.stride_ms=33:this.stride_ms+=.2*(Math.max(n,1)-this.stride_ms),this.b&&(e.time<this.b.time||e.n!==this.b.n)&&(this.jumped=!0),this.a=this.b&&!this.jumped?this.b:e,this.b=e,this.arrived_ms=t,this.drawn=!1,this.toThank.push(e.time)}hear(e){this.packets.push(...e)}advance(e){if(!this.a||!this.b||this.drawn)return null;let t=Math.min(1,(e-this.arrived_ms)/this.stride_ms);this.drawn=t>=1;let n={a:this.a,b:this.b,f:t,t_s:this.a.time+t*(this.b.time-this.a.time),jumped:this.jumped,packets:this.packets};this.jumped=!1,this.packets=[];for(let s of this.toThank)this.send({type:"got",time_s:s});return this.toThank=[],n}};var Uh=class{constructor(e,t){this.ticks_s=e;this.frames=new Array(e.length),this.most=Math.max(64,Math.floor(201326592/(40*Math.max(t,1)+200)))}ticks_s;frames;pinned=new Set;held=0;most;get size(){return this.held}get(e){return this.frames[e]}tickAt(e){let t=0,n=this.ticks_s.length,s=e+5e-10;for(;t<n;){let r=t+n>>1;this.ticks_s[r]<=s?t=r+1:n=r}return Math.max(0,t-1)}put(e,t,n){let s=this.tickAt(e.time);return this.frames[s]||(this.held+=1),this.frames[s]=e,n&&this.pinned.add(s),this.held>this.most&&this.makeRoom(t),s}before(e){for(let t=e;t>=0;t-=1)if(this.frames[t])return t;return-1}after(e){for(let t=e+1;t<this.frames.length;t+=1)if(this.frames[t])return t;return-1}clear(){this.frames.fill(void 0),this.pinned.clear(),this.held=0}cover(e){let t=new Array(e).fill(!1),n=this.frames.length;if(n===0)return t;let s=this.ticks_s[0],r=this.ticks_s[n-1]-s||1;for(let o=0;o<n;o+=1){if(!this.frames[o])continue;let a=Math.floor((this.ticks_s[o]-s)/r*e);t[Math.min(a,e-1)]=!0}return t}makeRoom(e){let t=[];for(let n=0;n<this.frames.length;n+=1)this.frames[n]&&!this.pinned.has(n)&&t.push(n);t.sort((n,s)=>Math.abs(s-e)-Math.abs(n-e));for(let n of t.slice(0,Math.ceil(this.most/8)))this.frames[n]=void 0,this.held-=1}};var VE=30,q0=3,GE=40,WE=15e3,XE=1e5,Y0=[.05,.1,.25,.5,1,2,5,10,20,50,100];function $0({from_s:i,to_s:e,step_s:t}){return`${i}/${e}/${t}`}var Oh=class{constructor(e,t,n){this.span=e;this.send=n;this.cache=new Uh(e.ticks_s,t),this.t_s=e.from_s,this.packetsTo_s=e.from_s}span;send;playing=new Tt(!1);speed=new Tt(1);waiting=new Tt(!1);cache;t_s;shown=null;dirty=!0;jumped=!0;last_ms=null;fetch=null;fetches=0;brought=0;barren="";overview=!1;packets=[];packetsTo_s;get time_s(){return this.t_s}get frame(){return this.shown?this.shown.f<.5?this.shown.a:this.shown.b:null}get busy(){return this.playing.value||this.dirty||this.waiting.value}get atEnd(){return this.t_s>=this.span.to_s}play(e){e&&this.atEnd&&this.seek(this.span.from_s),this.last_ms=null,this.playing.value=e&&this.span.to_s>this.span.from_s,this.dirty=!0,this.plan()}seek(e){let t=Math.min(Math.max(e,this.span.from_s),this.span.to_s);this.last_ms=null,this.jumped||=t<this.t_s||t>this.t_s+2*this.span.period_s,this.t_s=t,this.packetsTo_s=t-(this.jumped?this.span.period_s:0),this.dirty=!0,this.plan()}stepTick(e){this.playing.value=!1;let t=this.span.ticks_s,n=this.cache.tickAt(this.t_s),s=this.t_s>t[n]+1e-9,r=e>0?n+1:s?n:n-1;this.seek(t[Math.min(Math.max(r,0),t.length-1)]??this.t_s)}faster(e){let t=this.speed.value,n=e>0?Y0.find(s=>s>t):Y0.findLast(s=>s<t);n!==void 0&&(this.speed.value=n),this.plan()}forget(){this.cache.clear(),this.fetch=null,this.overview=!1,this.dirty=!0,this.plan()}take(e){this.send({type:"got",time_s:e.time}),this.brought+=1,this.cache.put(e,this.cache.tickAt(this.t_s),this.fetch?.why==="overview"),this.dirty=!0}hear(e){if(e.length===0)return;let t=this.packets.at(-1)?.t??-1/0;if(e[0].t>t)this.packets.push(...e);else{let n=new Set(this.packets.map(s=>`${s.t}/${s.from}`));this.packets.push(...e.filter(s=>!n.has(`${s.t}/${s.from}`))),this.packets.sort((s,r)=>s.t-r.t)}if(this.packets.length>XE){let n=this.t_s;this.packets=this.packets.filter(s=>Math.abs(s.t-n)<10*this.span.period_s+5)}}fetched(e){this.fetch?.id===e&&(this.fetch.why==="overview"&&(this.overview=!0),this.barren=this.brought>0?"":$0(this.fetch),this.fetch=null,this.dirty=!0,this.plan())}advance(e){if(this.playing.value&&this.walk(e),!this.dirty)return null;let t=this.pair();if(this.waiting.value=!t?.exact,this.dirty=!1,this.plan(),!t)return null;this.shown=t;let n={...t,t_s:this.t_s,jumped:this.jumped,packets:this.packetsUntil(this.t_s)};return this.jumped=!1,n}walk(e){let t=this.last_ms===null?0:Math.min((e-this.last_ms)/1e3,.5);this.last_ms=e;let n=Math.min(this.t_s+t*this.speed.value,this.span.to_s),s=this.readyTo();if(n>this.t_s){let r=Math.max(this.t_s,Math.min(n,s));r>this.t_s&&(this.t_s=r,this.dirty=!0)}this.waiting.value=s<n,this.waiting.value&&this.plan(),this.atEnd&&(this.playing.value=!1)}readyTo(){let e=this.span.ticks_s,t=this.cache.before(this.cache.tickAt(this.t_s));if(t<0||!this.near(t,this.cache.tickAt(this.t_s)))return this.t_s;let n=t,s=this.t_s+q0*this.speed.value;for(;e[n]<s;){let r=this.cache.after(n);if(r<0||!this.near(n,r))break;n=r}return Math.max(e[n],this.t_s)}step(){if(!this.playing.value)return 0;let e=this.speed.value/VE;return e>1.5*this.span.period_s?e:0}near(e,t){let n=this.span.ticks_s;return t-e<=1||n[t]-n[e]<=2*this.step()}pair(){let e=this.span.ticks_s,t=this.cache.tickAt(this.t_s),n=this.cache.before(t),s=this.cache.after(t),r=this.cache.get(n),o=this.cache.get(s),a=n===t&&Math.abs(e[t]-this.t_s)<1e-9,l=t===e.length-1;if(r&&(a||l&&n===t))return{a:r,b:r,f:0,exact:!0};if(r&&o&&this.near(n,s))return{a:r,b:o,f:Math.max(0,(this.t_s-r.time)/(o.time-r.time)),exact:!0};if(!r&&!o)return null;let c=r&&(!o||this.t_s-r.time<=o.time-this.t_s)?r:o;return{a:c,b:c,f:0,exact:!1}}packetsUntil(e){let t=this.packetsTo_s;return this.packetsTo_s=e,e<=t?[]:this.packets.filter(n=>n.t>t&&n.t<=e)}plan(){let e=this.want(),t=this.fetch;if(!e||t&&performance.now()-t.sent_ms<WE&&(!(e.why==="now"||e.why==="ahead"&&t.why==="overview"&&this.playing.value)||t.why==="now"||t.why==="ahead"&&t.from_s<=e.from_s&&e.from_s<=t.to_s)||$0(e)===this.barren)return;let n=++this.fetches,{from_s:s,to_s:r,step_s:o}=e;this.send({type:"fetch",id:n,from_s:s,to_s:r,step_s:o})&&(this.fetch={...e,id:n,sent_ms:performance.now()},this.brought=0)}want(){let e=this.span.ticks_s;if(e.length===0)return null;let t=this.cache.tickAt(this.t_s),n=this.cache.before(t);if(n<0||!this.near(n,t))return{why:"now",from_s:e[t],to_s:e[t],step_s:0};let s=this.step();if(!this.playing.value){let l=t+1;if(this.t_s>e[t]+1e-9&&l<e.length&&!this.cache.get(l))return{why:"now",from_s:e[l],to_s:e[l],step_s:0};if(!this.overview){let c=this.span.to_s-this.span.from_s;return{why:"overview",from_s:this.span.from_s,to_s:this.span.to_s,step_s:c/GE}}}let r=this.playing.value?q0*this.speed.value:5*this.span.period_s,o=Math.min(this.t_s+r,this.span.to_s),a=n;for(;e[a]<o;){let l=this.cache.after(a);if(l<0||!this.near(a,l)){if(this.playing.value&&e[a]-this.t_s>r/2)return null;let c=Math.min(a+1,e.length-1);return c===a?null:{why:"ahead",from_s:e[c],to_s:o,step_s:s}}a=l}return null}};var hf=1e4,qE=["battery/soc","battery","soc"];function Wa(i){let e=i.ofVehicles();return qE.find(t=>e.has(t))??null}var Bh=class{constructor(e,t){this.hello=e;this.connection=t;this.series.known.on(()=>this.askColour()),e.vehicles.paths.forEach((s,r)=>this.numbers.set(s,r));let n=s=>t.send(s);e.mode==="replay"&&e.replay?(this.live=null,this.replay=new Oh(e.replay,e.vehicles.paths.length,n),this.player=this.replay,this.time.value=e.replay.from_s):(this.live=new Fh(n),this.replay=null,this.player=this.live)}hello;connection;series=new Nh;state=new Tt(null);details=new Tt(null);links=new Tt([]);wind=new Tt([]);legend=new Tt(null);notice=new Tt(null);marks=[];marked=new Tt(0);marksDropped=0;time=new Tt(0);selected=new Tt(null);following=new Tt(!1);layers=new Tt(YE());colour=new Tt({by:"kind",name:""});has=new Tt({radio:!1,wind:!1,beams:!1});charts=new Tt(null);gone=new AbortController;live;replay;player;onBusy=()=>{};colourAsked=null;numbers=new Map;linkTimes=[];get name(){return(this.hello.name.split(/[/\\]/).at(-1)??"").replace(/\.(toml|xml|mcap)$/,"")||"a run without a name"}get count(){return this.hello.vehicles.paths.length}path(e){return this.hello.vehicles.paths[e]??`vehicle ${e}`}number(e){return this.numbers.get(e)}send(e){this.connection.send(e)||this.say("The program is not there: this cannot be done now.",!0)}say(e,t=!1){this.notice.value={text:e,bad:t}}hear(e){switch(e.type){case"state":this.state.value=e;break;case"series":this.series.declare(e.list);break;case"history":this.series.fill(e.id,e.times_s,e.values),this.series.lines.get(e.id)?.about.name==="packets/sent"&&this.found({radio:e.values.some(Boolean)});break;case"marks":this.mark(e.list,e.dropped);break;case"packets":this.found({radio:e.list.length>0}),(this.live??this.replay)?.hear(e.list);break;case"links":this.found({radio:e.list.length>0}),this.hearLinks(e.t,e.list);break;case"wind":this.found({wind:e.arrows.length>0}),this.wind.value=e.arrows;break;case"details":e.vehicle===this.selected.value&&(this.details.value=e),this.found({radio:e.radios.length>0,beams:e.sensors.some(t=>t.beams!==null)});break;case"fetched":this.replay?.fetched(e.id),this.onBusy();break;case"error":this.say(e.text,!0);break}}select(e){e!==this.selected.value&&(this.details.value=null,e===null&&(this.following.value=!1),this.selected.value=e,this.askDetails())}askDetails(){let e=this.selected.value;this.connection.send(this.replay&&e!==null?{type:"select",vehicle:e,t:this.replay.time_s}:{type:"select",vehicle:e})}paint(e){let t=this.colour.value;t.by===e.by&&t.name===e.name||(this.colour.value=e,this.askColour())}colourSeries(){let{by:e,name:t}=this.colour.value;return e==="battery"?Wa(this.series):e==="value"&&this.series.ofVehicles().has(t)?t:null}askColour(){let e=this.colourSeries();e===this.colourAsked||!this.connection.send({type:"colour",by:e})||(this.colourAsked=e,this.replay?.forget(),this.onBusy())}toggleLayer(e){this.layers.value={...this.layers.value,[e]:!this.layers.value[e]}}seek(e){this.replay?.seek(e),this.onBusy()}seekMark(e){if(!this.replay)return;let t=this.replay.time_s,n=this.selected.value,s=n===null?[]:this.marks.filter(l=>l.who.includes(n)),r=s.length>0?s:this.marks,o=e>0?r.find(l=>l.t>t+1e-9):r.findLast(l=>l.t<t-1e-9);if(!o){this.say(e>0?"No mark after this time.":"No mark before this time.");return}this.replay.play(!1),this.seek(o.t);let a=o.who.map(l=>this.path(l)).join(", ");this.say([o.kind,a,o.text].filter(l=>l!=="").join(" · "))}linksAt(e){return this.linkTimes.findLast(t=>t.t<=e+1e-9)?.list??[]}repeat(){this.selected.value!==null&&this.askDetails()}found(e){let t={...this.has.value};for(let n of Object.keys(e))t[n]||=e[n]??!1;JSON.stringify(t)!==JSON.stringify(this.has.value)&&(this.has.value=t)}hearLinks(e,t){if(!this.replay){this.links.value=t;return}let n=this.linkTimes.find(s=>s.t===e);if(n)n.list=t;else if(this.linkTimes.push({t:e,list:t}),this.linkTimes.sort((s,r)=>s.t-r.t),this.linkTimes.length>500){let s=this.replay.time_s;this.linkTimes.sort((r,o)=>Math.abs(r.t-s)-Math.abs(o.t-s)).length=250,this.linkTimes.sort((r,o)=>r.t-o.t)}this.links.value=this.linksAt(this.replay.time_s)}mark(e,t){if(this.marksDropped+=t,e.length===0&&t===0)return;let n=this.marks.at(-1)?.t??-1/0;this.marks.push(...e),e.some((s,r)=>s.t<(r>0?e[r-1].t:n))&&this.marks.sort((s,r)=>s.t-r.t),this.marks.length>hf&&(this.marksDropped+=this.marks.length-hf,this.marks=this.marks.slice(-hf)),this.marked.value+=1}};function YE(){let i=new Set(["links","packets","beams","wind","grid","world"]);return Object.fromEntries(Hs.map(e=>[e,i.has(e)]))}var $E=["speed","packets/sent","packets/received","packets/delivery","contacts","energy"],ZE=4,Z0=250,KE="time";function J0(i,e){let t=B("div",{class:"charts",id:"chart-row"}),n=B("select",{id:"add-chart","aria-label":"add a chart",title:"Add a chart"}),s=B("p",{class:"empty faint",text:"No numbers yet."}),r=new Map,o=()=>{let f=kh(i),g=new Set(f.map(qi));for(let[p,m]of r)g.has(p)||(m.dispose(),r.delete(p));for(let p of f)r.has(qi(p))||r.set(qi(p),new uf(i,p,()=>a(p)));let v=f.map(p=>r.get(qi(p)).element);(v.some((p,m)=>t.children[m]!==p)||t.children.length!==v.length)&&t.replaceChildren(...v),et(s,f.length===0),l(f);for(let p of r.values())p.update()},a=f=>{i.charts.value=kh(i).filter(g=>qi(g)!==qi(f))},l=f=>{let g=new Set(f.map(qi)),v=(A,E)=>B("option",{value:qi(A),text:`${Gs(A.name)}${E==="1"||E===""?"":`, ${E}`}`}),p=i.series.ofRun().map(({about:A})=>({key:{name:A.name,own:!1},of:A.unit})),m=[...i.series.ofVehicles()].map(([A,E])=>({key:{name:A,own:!0},of:E})),y=(A,E)=>{let _=E.filter(({key:T})=>!g.has(qi(T)));return _.length>0&&B("optgroup",{label:A},..._.map(({key:T,of:O})=>v(T,O)))},R=[y("of the run",p),y("of the selected vehicle",m)].filter(A=>A!==!1),b=R.flatMap(A=>[...A.children].map(E=>E.value)).join(`
`);n.dataset.wanted!==b&&(n.dataset.wanted=b,n.replaceChildren(B("option",{value:"",text:"+","aria-label":"add a chart"}),...R)),et(n,R.length>0)};n.addEventListener("change",()=>{n.value!==""&&(i.charts.value=[...kh(i),JE(n.value)]),n.value=""});let c=Ui(Z0,o);i.series.known.now(c),i.charts.on(o),i.selected.on(o);let h=Ui(Z0,()=>{if(i.charts.value===null&&jE(kh(i))!==[...r.keys()].join(`
`))o();else for(let f of r.values())f.update()});i.time.on(h),i.state.on(h);let u=e.dark.on(()=>{for(let f of r.values())f.rebuild()}),d=e.large.on(()=>{for(let f of r.values())f.rebuild()});return i.gone.signal.addEventListener("abort",()=>{u(),d();for(let f of r.values())f.dispose()}),B("section",{class:"panel below",id:"charts","aria-label":"charts"},t,B("div",{class:"charttools"},s,n))}function qi(i){return(i.own?"own:":"")+i.name}function JE(i){return i.startsWith("own:")?{name:i.slice(4),own:!0}:{name:i,own:!1}}function jE(i){return i.map(qi).join(`
`)}function kh(i){if(i.charts.value!==null)return i.charts.value;let e=a=>a!==void 0&&a.values.some(l=>l!==null&&l!==0),t=$E.filter(a=>e(i.series.find(a,null))),n=i.series.ofRun().map(a=>a.about.name).filter(a=>a.endsWith("/mean")&&e(i.series.find(a,null))),s=[...t,...n].slice(0,ZE).map(a=>({name:a,own:!1})),r=Wa(i.series),o=i.selected.value;return r&&o!==null&&i.series.find(r,o)&&s.push({name:r,own:!0}),s}var uf=class{constructor(e,t,n){this.run=e;this.key=t;let s=Gs(t.name);this.element=B("figure",{class:"chart","data-series":qi(t)},B("figcaption",{},B("span",{class:"cut",text:s,title:t.own?`${s} of the selected vehicle`:s}),t.own&&B("span",{class:"own",title:"of the selected vehicle"}),this.value,ut(`Remove the chart of ${s}`,null,yt("close"),n,{class:"tool small"})),this.field),this.sizes=new ResizeObserver(()=>this.resize()),this.sizes.observe(this.field)}run;key;element;field=B("div",{class:"field"});value=B("output",{class:"figure"});plot=null;drawn={line:null,version:-1,now_s:NaN};sizes;dispose(){this.sizes.disconnect(),this.plot?.destroy()}rebuild(){this.plot?.destroy(),this.plot=null,this.drawn.version=-1,this.update()}update(){let e=this.line(),t=this.run.time.value;if(!e){at(this.value,this.key.own&&this.run.selected.value===null?"select a vehicle":"–"),this.plot?.setData([[],[]]),this.drawn={line:null,version:-1,now_s:t};return}!e.asked&&e.about.vehicle!==null&&(e.asked=!0,this.run.send({type:"history",id:e.about.id})),this.plot||this.build(),this.plot&&(this.drawn.line!==e||this.drawn.version!==e.version?this.plot.setData([e.times,e.values]):this.run.replay&&this.drawn.now_s!==t&&this.plot.redraw(!1,!1),this.drawn={line:e,version:e.version,now_s:t},this.tell(this.plot))}line(){let{selected:e,series:t}=this.run;return this.key.own?e.value===null?void 0:t.find(this.key.name,e.value):t.find(this.key.name,null)}tell(e){let t=this.line();if(!t)return;let n=e.cursor.idx,s=e.cursor.left!==void 0&&e.cursor.left>=0&&n!==null&&n!==void 0,r=s?t.values[n]??null:this.run.replay?t.at(this.run.time.value):t.last,o=s?` at ${Pn(t.times[n]??0)}`:"";at(this.value,`${hi(r)}${ja(t.about.unit)}${o}`)}build(){let e=this.field.clientWidth,t=this.field.clientHeight;if(e<40||t<30)return;let n=getComputedStyle(this.element),s=c=>n.getPropertyValue(c).trim(),r=Number.parseFloat(n.fontSize)*.8,o=`${r}px ${n.fontFamily}`,a=(c,h)=>({stroke:s("--faint"),font:o,size:h,gap:3,space:r*5,grid:{stroke:s("--grid"),width:1},ticks:{show:!1},values:(u,d)=>d.map(f=>c(f,d.length>1?d[1]-d[0]:1))}),{replay:l}=this.run;this.plot=new On({width:e,height:t,padding:[6,r*1.2,0,0],legend:{show:!1},scales:{x:l?{time:!1,range:[l.span.from_s,Math.max(l.span.to_s,l.span.from_s+.001)]}:{time:!1},y:{range:QE}},axes:[a((c,h)=>Pn(c,K0(h)),r*1.8),{...a((c,h)=>Math.abs(c)<1e3?Qn(c,K0(h)):hi(c),r*4),space:r*2.2}],series:[{},{stroke:s("--accent"),width:1.5,points:{show:!1},spanGaps:!1}],cursor:{sync:{key:KE,setSeries:!1},drag:{x:!1,y:!1,setScale:!1},y:!1,points:{size:6}},hooks:{draw:l?[c=>this.drawNow(c,s("--now"))]:[],setCursor:[c=>this.tell(c)]}},[[],[]],this.field),l&&this.seekable(this.plot.over)}seekable(e){let t=n=>{if(!this.plot||!this.run.replay)return;let s=n.clientX-e.getBoundingClientRect().left;this.run.replay.play(!1),this.run.seek(this.plot.posToVal(s,"x"))};e.addEventListener("pointerdown",n=>{n.button===0&&(e.setPointerCapture(n.pointerId),t(n))}),e.addEventListener("pointermove",n=>{e.hasPointerCapture(n.pointerId)&&t(n)})}drawNow(e,t){let n=Math.round(e.valToPos(this.run.time.value,"x",!0)),{left:s,top:r,width:o,height:a}=e.bbox;if(n<s||n>s+o)return;let{ctx:l}=e;l.save(),l.fillStyle=t,l.fillRect(n-devicePixelRatio/2,r,Math.max(1,devicePixelRatio),a),l.restore()}resize(){let e=this.field.clientWidth,t=this.field.clientHeight;e<40||t<30||(this.plot?this.plot.setSize({width:e,height:t}):this.update())}};function K0(i){for(let e=0;e<6;e+=1)if(Math.abs(i*10**e-Math.round(i*10**e))<1e-6)return e;return 6}function QE(i,e,t){if(e===null||t===null)return[0,1];if(e===t)return e===0?[0,1]:e>0?[0,e*1.25]:[e*1.25,0];let n=(t-e)*.08,s=e>=0&&e<.6*t?0:e-n,r=t<=0&&t>.6*e?0:t+n;return[s,r]}var e1=[["drag","orbit"],["right drag, or two fingers","move sideways"],["wheel, or pinch","nearer and farther"],["click","select a vehicle"]];function j0(i,e){let t=new Map;for(let o of e)t.set(o.group,[...t.get(o.group)??[],o]);let n=(o,a)=>B("tr",{},B("th",{scope:"row"},...o.flatMap((l,c)=>[c>0&&" ",B("kbd",{text:t1(l)})])),B("td",{text:a})),s=(o,a)=>B("section",{},B("h3",{text:o}),B("table",{},...a)),r=B("dialog",{class:"sheet",id:"help","aria-labelledby":"help-title"});return r.append(B("div",{class:"head"},B("h2",{id:"help-title",text:"Keys"}),ut("Close","Escape",yt("close"),()=>r.close(),{class:"tool"})),B("div",{class:"columns"},...[...t].map(([o,a])=>s(o,a.map(l=>n(l.keys,l.does)))),s("Mouse and touch",e1.map(([o,a])=>B("tr",{},B("th",{scope:"row",text:o}),B("td",{text:a}))))),B("p",{class:"faint",text:`Simbeeotic ${i.hello.version}`})),r.addEventListener("click",o=>{o.target===r&&r.close()}),{element:r,toggle(){r.open?r.close():r.showModal()}}}function t1(i){return{ArrowLeft:"←",ArrowRight:"→",Escape:"Esc",Space:"Space"}[i]??i.replace("Shift+","Shift ")}function n1(i){return i.key===" "?"Space":/^[a-z]$/i.test(i.key)?(i.shiftKey?"Shift+":"")+(i.shiftKey?i.key.toUpperCase():i.key.toLowerCase()):i.key}function i1(i){return i instanceof HTMLElement?i instanceof HTMLInputElement?!["checkbox","radio","button"].includes(i.type):i instanceof HTMLTextAreaElement||i instanceof HTMLSelectElement||i.isContentEditable:!1}function Q0(i,e){let t=new Map;for(let n of i)for(let s of n.keys)t.set(s,n);document.addEventListener("keydown",n=>{if(n.ctrlKey||n.altKey||n.metaKey||n.defaultPrevented||i1(n.target))return;let s=n1(n);if((n.target instanceof HTMLButtonElement||n.target instanceof HTMLElement&&n.target.tagName==="SUMMARY")&&(s==="Enter"||s==="Space"&&!n.target.closest(".bar")))return;let o=t.get(s);o&&(n.preventDefault(),o.act())},{signal:e})}var df={labels:"Names",trails:"Trails",links:"Radio links",packets:"Packets",beams:"Sensor beams",wind:"Wind",grid:"Grid",world:"World"},ff=[["orbit","From above and aside","o","Orbit"],["top","From above","t","Top"],["north","From the north","n","N"],["east","From the east","e","E"],["south","From the south","s","S"],["west","From the west","w","W"]];function ev(i,e,t){return B("section",{class:"panel left",id:"layers","aria-label":"layers and colours"},B("h2",{text:"Show"}),s1(i),B("h2",{text:"Colour by"}),r1(i),o1(i),B("h2",{text:"View"}),B("div",{class:"views"},...ff.map(([n,s,r,o])=>ut(s,r,o,()=>e(n),{class:"tool plain"})),ut("All vehicles in sight","a","Fit",t,{class:"tool plain",id:"fit"})))}function s1(i){let e=B("div",{class:"checks"}),t=new Map;return Hs.forEach((n,s)=>{let r=B("input",{type:"checkbox",id:`layer-${n}`,"aria-keyshortcuts":String(s+1),on:{change:()=>i.toggleLayer(n)}}),o=B("label",{class:"check"},r,B("span",{text:df[n]}),B("kbd",{text:String(s+1)}));t.set(n,{row:o,box:r}),e.append(o)}),i.layers.now(n=>{for(let[s,{box:r}]of t)r.checked=n[s]}),i.has.now(n=>{for(let s of["links","packets"])et(t.get(s).row,n.radio);et(t.get("wind").row,n.wind),et(t.get("beams").row,n.beams),et(t.get("world").row,i.hello.stage.props.length>0)}),e}function r1(i){let e=B("select",{id:"colour-by","aria-label":"colour vehicles by"}),t=()=>{let n=(h,u)=>B("option",{value:h,text:u}),s=[n("kind","kind"),n("speed","speed")],r=Wa(i.series);r&&s.push(n("battery","battery"));for(let[h,u]of i.series.ofVehicles())h!==r&&s.push(n(`value:${h}`,`${Gs(h)}${ja(u)}`));let{by:o,name:a}=i.colour.value,l=o==="value"?`value:${a}`:o;s.some(h=>h.value===l)||s.push(n(l,Gs(a||o))),[...e.options].map(h=>h.value).join(`
`)===s.map(h=>h.value).join(`
`)||e.replaceChildren(...s),e.value=l};return e.addEventListener("change",()=>{let[n,...s]=e.value.split(":");i.paint({by:n,name:s.join(":")})}),i.series.known.now(t),i.colour.on(t),e}function o1(i){let e=B("div",{class:"legend",id:"legend","aria-label":"legend"});return i.legend.now(t=>{e.replaceChildren(...t?a1(t):[]),et(e,t!==null)}),e}function a1(i){if(i.names)return i.names.slice(0,12).map(([r,o])=>{let a=B("span",{class:"dot"});return a.style.background=o,B("div",{class:"entry"},a,B("span",{class:"cut",text:r,title:r}))});let e=B("div",{class:"ramp"});e.style.background=`linear-gradient(to right, ${i.stops.join(", ")})`;let t=Math.max(Math.abs(i.low),Math.abs(i.high))<1e3,n=i.high-i.low,s=r=>t&&n>0?Qn(r,Math.max(0,2-Math.floor(Math.log10(n)))):hi(r);return[e,B("div",{class:"ends"},B("span",{text:s(i.low)}),B("span",{class:"faint cut",text:`${i.title}${i.unit&&i.unit!=="1"?`, ${i.unit}`:""}`}),B("span",{text:s(i.high)}))]}var zh=class{open;tab=new Tt("vehicles");narrow=matchMedia("(max-width: 52rem)");constructor(){this.open=new Tt(this.narrow.matches?new Set:new Set(["layers","vehicles","charts"]))}has(e){return this.open.value.has(e)}set(e,t){if(this.has(e)===t)return;let n=new Set(this.narrow.matches?[]:this.open.value);t?n.add(e):n.delete(e),this.open.value=n}toggle(e){this.set(e,!this.has(e))}toggleTab(e){this.has("vehicles")&&this.tab.value===e?this.set("vehicles",!1):(this.tab.value=e,this.set("vehicles",!0))}};var tv=[.01,.02,.05,.1,.25,.5,1,2,5,10,20,50,100];function pf(i){let e=()=>{let t=i.state.value?.ended;return t&&i.say(`The run has ended: ${t}.`),!t};return{toggle(){e()&&i.send({type:i.state.value?.paused?"resume":"pause"})},instant(){e()&&i.send({type:"step",instants:1})},tenth(){e()&&i.send({type:"step",seconds:.1})},pace(t){if(!e())return;let n=i.state.value?.factor??(t<0?i.state.value?.speed??1:null);if(n===null)return;let s=t>0?tv.find(r=>r>n*1.001):tv.findLast(r=>r<n*.999);s!==void 0?i.send({type:"pace",factor:s}):t>0&&i.send({type:"pace",factor:null})},setPace(t){e()&&i.send({type:"pace",factor:t})}}}function nv(i,e){let t=ut("Pause","Space",yt("pause"),e.toggle,{class:"tool main",id:"pause"}),n=B("output",{class:"pace",id:"pace","aria-label":"pace asked for"}),s=B("span",{class:"fact faint",id:"measured"}),r=B("div",{class:"progress",role:"progressbar","aria-label":"share of the run"}),o=B("div",{class:"done"});r.append(o);let a=B("span",{class:"fact",id:"ended"}),l=ut("Step 0.1 s",">",B("span",{},"0.1 s"),e.tenth,{class:"tool",id:"step-tenth"});l.prepend(yt("step"));let c=[t,ut("Step one instant",".",yt("step"),e.instant,{class:"tool",id:"step-instant"}),l,B("span",{class:"gap"}),ut("Slower","-",yt("slower"),()=>e.pace(-1),{class:"tool",id:"slower"}),n,ut("Faster","+",yt("faster"),()=>e.pace(1),{class:"tool",id:"faster"}),ut("As time on the wall (1 ×)","0","1 ×",()=>e.setPace(1),{class:"tool",id:"real-time"}),ut("As fast as possible","9","max",()=>e.setPace(null),{class:"tool",id:"max-pace"})];return i.state.now(h=>{let u=h?.paused??!1;t.replaceChildren(yt(u?"play":"pause")),t.title=u?"Resume (Space)":"Pause (Space)",t.setAttribute("aria-label",u?"Resume":"Pause"),at(n,h===null?"–":h.factor===null?"max":Vs(h.factor)),at(s,h&&!u&&!h.ended?`measured ${Vs(Math.round(h.speed*100)/100)}`:"");for(let d of c)et(d,!h?.ended);et(s,!h?.ended),at(a,h?.ended?`The run has ended at ${Pn(h.time_s)}: ${h.ended}.`:"")}),i.time.now(h=>{let u=i.hello.end_s,d=u?Math.min(1,h/u):0;o.style.width=`${100*d}%`,r.setAttribute("aria-valuenow",String(Math.round(100*d)))}),et(r,i.hello.end_s!==null),B("footer",{class:"bar bottom live","aria-label":"control of the run"},...c,s,a,B("span",{class:"stretch"}),r)}var l1=4e3,c1=12e3;function iv(i){let e=B("span",{}),t=B("div",{class:"notice",hidden:!0},e,ut("Close",null,yt("close"),()=>i.value=null,{class:"tool small"})),n;return i.now(s=>{clearTimeout(n),et(t,s!==null),s&&(t.classList.toggle("bad",s.bad),t.setAttribute("role",s.bad?"alert":"status"),at(e,s.text),n=setTimeout(()=>i.value=null,s.bad?c1:l1))}),t}function sv(i,e,t){let n=B("span",{}),s=B("div",{class:"lost",id:"lost",role:"alert",hidden:!0},n,ut("Try now",null,"Try now",t,{class:"tool plain"}));return i.now(r=>{let o=e(),a=o?.state.value?.ended;at(n,a?`The program has closed after the run had ended (${a}). What you see is how it was.`:o?"The program is gone: it was stopped, or the connection broke. The page goes on trying.":"The program does not answer. Is it still running? The page goes on trying."),r==="lost"?et(s,!0):r==="open"&&et(s,!1)}),s}function rv(i,e){let t=B("div",{class:"card waiting",id:"waiting",hidden:!0},B("p",{text:"This run waits for you."}),ut("Start","Space","Start",e,{class:"tool start"})),n=()=>{let s=i.state.value;et(t,s!==null&&s.paused&&s.ended===null&&s.time_s===0)};return i.state.now(n),t}function ov(i,e,t){let{from_s:n,to_s:s}=e.span,r=Math.max(s-n,1e-9),o=B("canvas",{"aria-hidden":"true"}),a=B("span",{class:"hint",hidden:!0}),l=B("div",{class:"timeline",id:"timeline",role:"slider",tabindex:"0","aria-label":"time","aria-valuemin":String(n),"aria-valuemax":String(s)},o,a),c=()=>6,h=m=>c()+(m-n)/r*(l.clientWidth-2*c()),u=m=>{let y=l.getBoundingClientRect(),R=(m.clientX-y.left-c())/Math.max(1,y.width-2*c());return n+Math.min(1,Math.max(0,R))*r},f=Ui(30,()=>u1(o,l,i,e,h));new ResizeObserver(f).observe(l),i.marked.on(f),i.selected.on(f),i.time.now(m=>{l.setAttribute("aria-valuenow",m.toFixed(3)),l.setAttribute("aria-valuetext",Pn(m)),f()});let g=setInterval(f,500),v=t.dark.on(f);i.gone.signal.addEventListener("abort",()=>{clearInterval(g),v()});let p=!1;return l.addEventListener("pointerdown",m=>{m.button===0&&(l.setPointerCapture(m.pointerId),p=e.playing.value,e.play(!1),i.seek(u(m)),l.focus(),m.preventDefault())}),l.addEventListener("pointermove",m=>{let y=u(m);at(a,Pn(y)),et(a,!0),a.style.left=`${Math.min(Math.max(h(y),28),l.clientWidth-28)}px`,l.hasPointerCapture(m.pointerId)&&i.seek(y)}),l.addEventListener("pointerup",m=>{l.hasPointerCapture(m.pointerId)&&(l.releasePointerCapture(m.pointerId),p&&e.play(!0),i.onBusy())}),l.addEventListener("pointerleave",()=>et(a,!1)),l.addEventListener("keydown",m=>{let y=r/20,R=e.time_s,A={PageUp:R-y,PageDown:R+y,Home:n,End:s}[m.key];A!==void 0&&(i.seek(A),m.preventDefault(),m.stopPropagation())}),l}function h1(i,e){return[.001,.002,.005,.01,.02,.05,.1,.2,.5,1,2,5,10,15,30,60,120,300,600,1800,3600,7200,21600,86400].find(n=>i/n<=e)??i}function u1(i,e,t,n,s){let r=e.clientWidth,o=e.clientHeight;if(r<20||o<10)return;let a=devicePixelRatio||1;i.width=Math.round(r*a),i.height=Math.round(o*a);let l=i.getContext("2d");if(!l)return;l.scale(a,a);let c=getComputedStyle(e),h=E=>c.getPropertyValue(E).trim(),{from_s:u,to_s:d}=n.span,f=Number.parseFloat(c.fontSize)*.85,g=Math.round(o*.42);l.fillStyle=h("--line"),l.fillRect(s(u),g-1.5,s(d)-s(u),3);let v=Math.max(1,Math.floor(r/3));l.fillStyle=h("--loaded"),n.cache.cover(v).forEach((E,_)=>{if(!E)return;let T=s(u+(d-u)*_/v);l.fillRect(T,g-1.5,r/v+.5,3)}),l.font=`${f}px ${c.fontFamily}`,l.textBaseline="bottom",l.textAlign="center";let p=h1(d-u,Math.max(2,r/(f*7))),m=p<.01?3:p<.1?2:p<1?1:0;for(let E=Math.ceil(u/p-1e-9);E*p<=d+1e-9;E+=1){let _=s(E*p),T=Pn(E*p,m),O=l.measureText(T).width/2;_-O<0||_+O>r||(l.fillStyle=h("--faint"),l.fillText(T,_,o))}let y=t.selected.value,R=[];l.fillStyle=h("--mark");let b=-10;for(let E of t.marks){let _=Math.round(s(E.t));y!==null&&E.who.includes(y)&&R.push(_),_!==b&&(b=_,l.fillRect(_-.5,g-7,1,5))}l.fillStyle=h("--accent");for(let E of R)l.fillRect(E-1,g-9,2,8);let A=s(t.time.value);l.fillRect(s(u),g-1.5,A-s(u),3),l.beginPath(),l.arc(A,g,6,0,2*Math.PI),l.fill(),l.lineWidth=2,l.strokeStyle=h("--panel-solid"),l.stroke()}function mf(i,e){let t=n=>{n(),i.onBusy()};return{toggle:()=>t(()=>e.play(!e.playing.value)),step:n=>t(()=>e.stepTick(n)),faster:n=>t(()=>e.faster(n)),setSpeed:n=>t(()=>e.speed.value=n)}}function av(i,e,t,n){let s=ut("Play","Space",yt("play"),n.toggle,{class:"tool main",id:"play"});e.playing.now(a=>{s.replaceChildren(yt(a?"pause":"play")),s.title=a?"Pause (Space)":"Play (Space)",s.setAttribute("aria-label",a?"Pause":"Play")});let r=B("output",{class:"pace",id:"speed","aria-label":"speed"});e.speed.now(a=>at(r,Vs(a)));let o=[ut("Mark before","[",yt("lastMark"),()=>i.seekMark(-1),{class:"tool",id:"previous-mark"}),ut("Next mark","]",yt("nextMark"),()=>i.seekMark(1),{class:"tool",id:"next-mark"})];return i.marked.now(()=>{for(let a of o)a.hidden=i.marks.length===0}),B("footer",{class:"bar bottom replay","aria-label":"control of the replay"},s,ut("One tick back",",",yt("back"),()=>n.step(-1),{class:"tool",id:"tick-back"}),ut("One tick on",".",yt("step"),()=>n.step(1),{class:"tool",id:"tick-on"}),B("span",{class:"gap"}),ut("Slower","-",yt("slower"),()=>n.faster(-1),{class:"tool",id:"slower"}),r,ut("Faster","+",yt("faster"),()=>n.faster(1),{class:"tool",id:"faster"}),...o,ov(i,e,t))}function lv(i,e,t,n){let{hello:s}=i,r=B("span",{class:"badge",id:"run-state"}),o=B("output",{class:"clock",id:"clock","aria-label":"virtual time"}),a=B("span",{class:"faint wide",text:s.end_s===null?"":`of ${Pn(s.end_s,0)}`}),l=B("span",{class:"fact wide",id:"measured-speed",title:"virtual seconds per second"}),c=B("span",{class:"fact faint wide",title:"pages that look at this run"}),h=(p,m,y,R)=>{let b=ut(m,y,yt(R),()=>t.toggle(p),{class:"tool"});return i.gone.signal.addEventListener("abort",t.open.now(A=>b.setAttribute("aria-pressed",String(A.has(p))))),b},u=ut("Theme","d",yt("auto"),()=>e.nextTheme(),{class:"tool wide",id:"theme"}),d=e.theme.now(p=>{u.replaceChildren(yt(p)),u.title=`Theme: ${p} (d)`,u.setAttribute("aria-label",`Theme: ${p}`)}),f=ut("Large text","z",yt("text"),()=>e.large.value=!e.large.value,{class:"tool wide",id:"large-text"}),g=e.large.now(p=>f.setAttribute("aria-pressed",String(p)));i.gone.signal.addEventListener("abort",()=>{d(),g()}),i.time.now(p=>at(o,Pn(p)));let v=()=>{let p=i.state.value,[m,y]=d1(i);if(at(r,m),r.dataset.kind=y,r.title=p?.ended?`The run has ended: ${p.ended}`:"",p){let R=p.skipped>0?`, ${Ai(p.skipped)} frames skipped`:"";at(l,p.ended||p.paused?"":Vs(Math.round(p.speed*100)/100)),l.title=`virtual seconds per second, measured${R}`,at(c,p.viewers>1?`${hi(p.viewers)} viewers`:"1 viewer")}i.replay&&at(l,Vs(i.replay.speed.value)),et(c,p!==null)};return i.state.now(v),i.replay?.playing.on(v),i.replay?.speed.on(v),i.replay?.waiting.on(v),B("header",{class:"bar top","aria-label":"run"},B("h1",{class:"name",text:i.name,title:`${s.name}
Simbeeotic ${s.version}`}),B("span",{class:"fact faint wide",text:`seed ${s.seed}`}),B("span",{class:"fact faint wide",id:"vehicle-count",text:i.count===1?"1 vehicle":`${Ai(i.count)} vehicles`}),r,o,a,l,c,B("span",{class:"stretch"}),h("layers","Layers and colours","l","layers"),h("vehicles","Vehicles and marks","v","list"),h("charts","Charts","c","chart"),B("span",{class:"gap"}),ut("Save a picture (PNG)","i",yt("camera"),n.savePicture,{class:"tool",id:"save-picture"}),ut("Copy a link to this view","y",yt("link"),n.copyLink,{class:"tool",id:"copy-link"}),u,f,ut("Full screen","Shift+F",yt("full"),n.fullScreen,{class:"tool wide"}),ut("Keys and help","?",yt("help"),n.help,{class:"tool",id:"help-button"}))}function d1(i){if(i.replay)return i.replay.waiting.value?["loading","wait"]:i.replay.playing.value?["replay","run"]:["replay, paused","hold"];let e=i.state.value;return e?e.ended?["ended","end"]:e.paused?["live, paused","hold"]:["live","run"]:["live","hold"]}var gf=6,f1=120;function cv(i){let e=i.sensors.map(m1);return{element:B("section",{id:"sensors"},p1(),...e.map(t=>t.element)),update({sensors:t}){t.forEach((n,s)=>e[s]?.update(n))}}}function p1(){return B("table",{class:"facts values heading"},B("tr",{},B("th",{},B("h3",{text:"Sensors"})),B("td",{class:"figure faint",text:"reads"}),B("td",{class:"figure faint",text:"true"}),B("td")))}function m1(i){let e=i.reading?.length??i.truth?.length??0,t=Math.max(i.columns.length,1),n=B("span",{class:"faint figure"}),s=B("canvas",{class:"spark","aria-hidden":"true"}),r=Array.from({length:Math.min(e,gf)},(c,h)=>{let[u,d]=i.columns[h%t]??["",""],f=e>t?` ${Math.floor(h/t)+1}`:"",g=B("td",{class:"figure"}),v=B("td",{class:"figure faint"});return{row:B("tr",{},B("th",{scope:"row",text:`${u}${f}`.trim()}),g,v,B("td",{class:"faint",text:d==="1"?"":d})),reading:g,truth:v}}),o=e>gf?B("p",{class:"faint",text:`and ${e-gf} more values`}):null,a=B("table",{class:"facts values"},...r.map(c=>c.row)),l=[];return{element:B("div",{class:"sensor"},B("div",{class:"first"},B("strong",{class:"cut",text:i.name}),s,n),a,o),update(c){at(n,c.lost?"lost":c.t===null?"not read yet":Pn(c.t)),n.classList.toggle("warn",c.lost),r.forEach((h,u)=>{at(h.reading,hi(c.reading?.[u],4)),at(h.truth,hi(c.truth?.[u],4))}),c.t!==null&&c.t!==l.at(-1)?.t&&(c.t<(l.at(-1)?.t??-1/0)&&(l.length=0),l.push({t:c.t,reading:c.reading?.[0]??null,truth:c.truth?.[0]??null}),l.length>f1&&l.shift()),et(s,l.length>2),l.length>2&&g1(s,l)}}}function g1(i,e){let t=i.clientWidth||64,n=i.clientHeight||16,s=devicePixelRatio||1;i.width=t*s,i.height=n*s;let r=i.getContext("2d"),o=e.flatMap(f=>[f.reading,f.truth]).filter(f=>f!==null&&Number.isFinite(f));if(!r||o.length===0)return;r.scale(s,s);let a=Math.min(...o),l=Math.max(...o)-a||1,c=e[0].t,h=e.at(-1).t-c||1,u=getComputedStyle(i),d=(f,g,v)=>{r.beginPath();let p=!1;for(let m of e){let y=m[f];if(y===null||!Number.isFinite(y)){p=!1;continue}let R=1+(m.t-c)/h*(t-2),b=n-2-(y-a)/l*(n-4);p?r.lineTo(R,b):r.moveTo(R,b),p=!0}r.strokeStyle=u.getPropertyValue(g).trim(),r.lineWidth=v,r.stroke()};d("truth","--line-strong",1),d("reading","--accent",1.25)}function hv(i){let e=B("span",{class:"dot"}),t=B("h2",{class:"cut",id:"selected-name"}),n=B("p",{class:"faint cut",id:"selected-kind"}),s=ut("Follow","f","Follow",()=>i.following.value=!i.following.value,{class:"tool plain",id:"follow"});s.prepend(yt("target")),i.following.now(u=>s.setAttribute("aria-pressed",String(u)));let r=x1(),o=B("div",{class:"sections"}),a=B("p",{class:"empty faint",text:"Waiting for its details …"}),l=[],c="",h=()=>{let u=i.selected.value;u!==null&&i.player.frame&&r.update(i.player.frame,u)};return i.time.on(Ui(100,h)),i.selected.now(u=>{if(u===null)return;let{kinds:d,roles:f,colors:g}=i.hello.vehicles;at(t,i.path(u)),t.title=i.path(u);let v=f[u]&&f[u]!=="vehicle"?` · ${f[u]}`:"";at(n,`${d[u]??""}${v}`),e.style.background=(g[u]??"#888888").slice(0,7),h()}),i.details.now(u=>{et(a,u===null);let d=u?v1(u):"";if(d!==c&&(c=d,l=u?_1(i,u):[],o.replaceChildren(...l.map(f=>f.element))),u)for(let f of l)f.update(u)}),B("div",{class:"inspector",id:"inspector"},B("div",{class:"head"},e,B("div",{class:"titles"},t,n),s,ut("Back to the list","Escape",yt("close"),()=>i.select(null),{class:"tool",id:"unselect"})),r.element,a,o)}function v1(i){return JSON.stringify([i.vehicle,i.parts,i.sensors.map(e=>[e.name,e.columns,e.reading?.length??e.truth?.length??0]),i.battery!==null,i.radios.map(e=>e.name),i.packets.length>0])}function _1(i,e){let t=[];return e.battery&&t.push(y1()),e.sensors.length>0&&t.push(cv(e)),e.radios.length>0&&t.push(b1(e)),e.packets.length>0&&t.push(S1(i)),e.parts.length>0&&t.push(M1(e)),t}function x1(){let i=c=>B("td",{class:"figure",id:c}),[e,t,n]=[i("now-x"),i("now-y"),i("now-z")],[s,r,o]=[i("now-speed"),i("now-yaw"),i("now-climb")],a=(c,h,u,d)=>[B("th",{scope:"row",text:c,title:d}),h,B("td",{class:"faint",text:u})];return{element:B("table",{class:"facts motion","aria-label":"pose and speed"},B("tr",{},...a("x",e,"m","east"),...a("speed",s,"m/s","over ground and up")),B("tr",{},...a("y",t,"m","north"),...a("climb",o,"m/s","up")),B("tr",{},...a("z",n,"m","up"),...a("yaw",r,"°","from east, counter-clockwise"))),update(c,h){if(h>=c.n)return;let u=3*h;at(e,Qn(c.positions[u],2)),at(t,Qn(c.positions[u+1],2)),at(n,Qn(c.positions[u+2],2));let d=c.velocities;at(s,d?Qn(Math.hypot(d[u],d[u+1],d[u+2]),2):"–"),at(o,d?Qn(d[u+2],2):"–");let[f,g,v,p]=[0,1,2,3].map(y=>c.attitudes[4*h+y]/32767),m=Math.atan2(2*(f*p+g*v),1-2*(v*v+p*p));at(r,Qn(m*180/Math.PI,0))}}}function y1(){let i=B("div",{class:"charge",role:"meter","aria-label":"charge","aria-valuemin":"0","aria-valuemax":"100"}),e=B("div",{});i.append(e);let t=B("span",{class:"figure",id:"charge"}),n=B("p",{class:"faint"});return{element:B("section",{},B("h3",{text:"Battery"}),B("div",{class:"chargeline"},i,t),n),update({battery:s}){if(!s)return;let r=Math.min(Math.max(100*s.soc,0),100);e.style.width=`${r}%`,i.dataset.level=r<15?"low":r<35?"half":"full",i.setAttribute("aria-valuenow",r.toFixed(0)),at(t,`${Qn(r,r<10?1:0)} %`),at(n,`${Qn(s.voltage_v,2)} V, ${hi(s.current_a)} A, ${s.condition}`)}}}function b1(i){let e=i.radios.map(t=>{let n=B("span",{class:"faint"}),s=B("td",{class:"figure"}),r=B("td",{class:"figure"}),o=B("p",{class:"faint"});return{element:B("div",{class:"radio"},B("div",{class:"first"},B("strong",{class:"cut",text:t.name}),n),B("table",{class:"facts"},B("tr",{},B("th",{scope:"row",text:"sent"}),s,B("th",{scope:"row",text:"received"}),r)),o),state:n,sent:s,received:r,lost:o}});return{element:B("section",{},B("h3",{text:"Radio"}),...e.map(t=>t.element)),update({radios:t}){t.forEach((n,s)=>{let r=e[s];if(!r)return;at(r.state,[n.channel===null?"":`channel ${n.channel}`,n.state??""].filter(Boolean).join(", ")),at(r.sent,Ai(n.sent)),at(r.received,Ai(n.received));let o=Object.entries(n.lost).filter(([,a])=>a>0);at(r.lost,`lost: ${o.map(([a,l])=>`${Ai(l)} ${a}`).join(", ")}`),et(r.lost,o.length>0)})}}}function S1(i){let e=B("tbody",{id:"last-packets"});return{element:B("section",{},B("h3",{text:"Last packets"}),B("table",{class:"facts packets"},e)),update({packets:t}){let n=t.slice(-8).reverse();e.replaceChildren(...n.map(s=>{let r=s.other,o=r===null?B("span",{class:"faint",text:s.sent?"all":"–"}):B("button",{type:"button",class:"name-link cut",text:i.path(r),on:{click:()=>i.select(r)}});return B("tr",{},B("td",{class:"figure faint",text:Pn(s.t,3)}),B("td",{text:s.sent?"to":"from",class:"faint"}),B("td",{class:"grow"},o),B("td",{class:"figure",text:`${s.bytes} B`}),B("td",{class:"figure",text:s.rssi_dbm===null?"":`${Qn(s.rssi_dbm,0)} dBm`}))}))}}}function M1(i){let e=({place:n,name:s,parameters:r})=>B("details",{},B("summary",{},B("span",{class:"faint",text:n}),B("strong",{class:"cut",text:s})),r.length===0?B("p",{class:"faint",text:"no parameters"}):B("table",{class:"facts parameters"},...r.map(([o,a])=>B("tr",{},B("th",{scope:"row",text:o,title:o}),B("td",{text:a,title:a}))))),t=i.parts.map(e);return t[0]&&(t[0].open=!0),{element:B("section",{id:"parameters"},B("h3",{text:"Parameters"}),...t),update(){}}}function Hh(i,e,t){let n=B("div",{class:"rows"}),s=B("div",{class:"list",role:"list","aria-label":i,tabindex:"-1"},n),r=0,o=()=>e*Number.parseFloat(getComputedStyle(document.documentElement).fontSize),a=()=>{let l=o();n.style.height=`${r*l}px`;let c=Math.max(0,Math.floor(s.scrollTop/l)-4),h=Math.min(r,Math.ceil((s.scrollTop+s.clientHeight)/l)+4),u=document.activeElement instanceof HTMLElement?document.activeElement.dataset.index:void 0,d=n.contains(document.activeElement),f=[];for(let g=c;g<h;g+=1){let v=t(g);v.dataset.index=String(g),v.style.top=`${g*l}px`,v.style.height=`${l}px`,f.push(v)}n.replaceChildren(...f),d&&f.find(g=>g.dataset.index===u)?.focus({preventScroll:!0})};return s.addEventListener("scroll",a,{passive:!0}),new ResizeObserver(a).observe(s),{element:s,update(l){r=l,a()},reveal(l){let c=l*o();c<s.scrollTop?s.scrollTop=c:c+o()>s.scrollTop+s.clientHeight&&(s.scrollTop=c+o()-s.clientHeight)}}}function uv(i){let e=[],t=B("select",{id:"mark-kind","aria-label":"which marks"}),n=B("input",{type:"checkbox",id:"mark-own"}),s=B("label",{class:"check"},n,B("span",{text:"of the selected vehicle"})),r=B("p",{class:"empty faint"}),o=B("p",{class:"empty faint"}),a=Hh("marks",3.1,u=>{let d=e[u],f=d.who.slice(0,3).map(v=>i.path(v));d.who.length>3&&f.push(`and ${d.who.length-3} more`);let g=i.selected.value!==null&&d.who.includes(i.selected.value);return B("button",{type:"button",role:"listitem",class:g?"row two mine":"row two",on:{click:()=>l(d)}},B("span",{class:"first"},B("span",{class:"cut",text:f.join(", ")||d.kind}),B("span",{class:"faint end figure",text:Pn(d.t,3)})),B("span",{class:"faint cut second",text:[f.length>0?d.kind:"",d.text].filter(Boolean).join(": ")}))}),l=u=>{u.who.length>0&&(i.selected.value===null||!u.who.includes(i.selected.value))&&i.select(u.who[0]),i.replay&&(i.replay.play(!1),i.seek(u.t))},c=()=>{let d=["",...[...new Set(i.marks.map(g=>g.kind))].sort()];if(d.join(`
`)!==[...t.options].map(g=>g.value).join(`
`)){let g=t.value;t.replaceChildren(...d.map(v=>B("option",{value:v,text:v||"all marks"}))),t.value=d.includes(g)?g:""}let f=i.selected.value;et(s,f!==null),e=i.marks.filter(g=>(t.value===""||g.kind===t.value)&&(!n.checked||f===null||g.who.includes(f))),i.replay||e.reverse(),r.textContent=i.marks.length===0?"Nothing has happened yet: no contact, no event, no log line.":"No such mark.",et(r,e.length===0),o.textContent=`${Ai(i.marksDropped)} more were too many to show.`,et(o,i.marksDropped>0),a.update(e.length)},h=Ui(250,c);return t.addEventListener("change",c),n.addEventListener("change",c),i.marked.on(h),i.selected.on(c),c(),B("div",{class:"marks"},B("div",{class:"filters"},t,s),a.element,r,o)}function dv(i,e){let t=w1(i),n=hv(i),s=uv(i),r=(c,h,u)=>B("button",{type:"button",role:"tab",class:"tab",id:`tab-${c}`,text:h,title:`${h} (${u})`,"aria-controls":`panel-${c}`,on:{click:()=>e.tab.value=c}}),o={vehicles:r("vehicles","Vehicles","v"),marks:r("marks","Marks","m")},a={vehicles:B("div",{class:"tabpage",id:"panel-vehicles",role:"tabpanel","aria-labelledby":"tab-vehicles"},t.box,t.list,n),marks:B("div",{class:"tabpage",id:"panel-marks",role:"tabpanel","aria-labelledby":"tab-marks"},s)},l=()=>{for(let h of["vehicles","marks"])o[h].setAttribute("aria-selected",String(e.tab.value===h)),et(a[h],e.tab.value===h);let c=i.selected.value===null||t.wanted();et(t.list,c),et(n,!c)};return t.onWanted(l),i.selected.on(l),i.gone.signal.addEventListener("abort",e.tab.on(l)),i.marked.now(()=>{o.marks.textContent=i.marks.length>0?`Marks ${Ai(i.marks.length)}`:"Marks"}),l(),{element:B("section",{class:"panel right",id:"vehicles","aria-label":"vehicles and marks"},B("div",{class:"tabs",role:"tablist"},o.vehicles,o.marks),a.vehicles,a.marks),search(){e.tab.value="vehicles",e.set("vehicles",!0),t.focus()}}}function w1(i){let{paths:e,kinds:t,colors:n}=i.hello.vehicles,s=e.map((b,A)=>`${b} ${t[A]??""}`.toLowerCase()),r=e.map((b,A)=>A),o=r,a=0,l=()=>{},c=B("input",{type:"search",id:"search",placeholder:e.length===1?"1 vehicle":`Find among ${Ai(e.length)} vehicles`,"aria-label":"find a vehicle by name or kind","aria-keyshortcuts":"/",autocomplete:"off",spellcheck:"false"}),h=ut("Clear","Escape",yt("close"),()=>m(),{class:"tool small"}),u=B("div",{class:"search"},yt("search"),c,h),d=B("p",{class:"empty faint"}),f=Hh("vehicles",2,b=>{let A=o[b],E=B("span",{class:"dot"});return E.style.background=(n[A]??"#888888").slice(0,7),B("button",{type:"button",role:"listitem",class:b===a&&c.value!==""?"row at":"row","aria-current":A===i.selected.value?"true":void 0,on:{click:()=>y(A)}},E,B("span",{class:"cut",text:e[A]}),B("span",{class:"faint cut end",text:t[A]??""}))}),g=B("div",{class:"found"},f.element,d),v=()=>c.value.trim()!=="",p=()=>{let b=c.value.trim().toLowerCase().split(/\s+/).filter(Boolean);o=b.length===0?r:r.filter(A=>b.every(E=>s[A].includes(E))),a=0,et(d,o.length===0),d.textContent=e.length===0?"This run has no vehicles.":`No vehicle is called “${c.value.trim()}”.`,et(h,c.value!==""),f.element.scrollTop=0,l(),f.update(o.length)},m=()=>{c.value="",p()},y=b=>{i.select(b),m(),c.blur()},R=b=>{a=Math.min(Math.max(a+b,0),o.length-1),f.reveal(a),f.update(o.length)};return c.addEventListener("input",p),c.addEventListener("keydown",b=>{let A={ArrowDown:1,ArrowUp:-1,PageDown:10,PageUp:-10};if(b.key==="Enter"&&o[a]!==void 0)y(o[a]);else if(b.key==="Escape")c.value!==""?m():c.blur();else if(A[b.key]!==void 0&&o.length>0)R(A[b.key]);else return;b.preventDefault(),b.stopPropagation()}),i.selected.on(()=>f.update(o.length)),p(),{box:u,list:g,wanted:v,onWanted(b){l=b},focus(){c.focus(),c.select()}}}var E1=20,T1=2e3,Vh=class{constructor(e,t,n,s){this.run=e;this.settings=t;let r=B("div",{class:"scene",id:"scene"});this.element=B("div",{class:"page"},r),n.append(this.element),document.title=`${e.name} · ${e.replay?"replay":"live"} · Simbeeotic`;let o=B("div",{class:"hover",hidden:!0,"aria-hidden":"true"});try{this.scene=xg(r,{hello:e.hello,dark:t.dark.value,onPick:p=>this.pick(p),onHover:p=>{at(o,p??""),et(o,p!==null)},onCamera:()=>{},onLegend:p=>e.legend.value=p})}catch(p){this.scene=null,this.noScene=p instanceof Error?p.message:String(p)}r.addEventListener("pointermove",p=>{o.style.left=`${p.clientX}px`,o.style.top=`${p.clientY}px`});let a=e.live?pf(e):null,l=e.replay?mf(e,e.replay):null,c=dv(e,this.layout),h=J0(e,t),u=ev(e,p=>this.look(p),()=>this.fit()),d=this.keys(()=>c.search(),()=>f.toggle()),f=j0(e,d),g=lv(e,t,this.layout,{savePicture:()=>{this.savePicture()},copyLink:()=>{this.copyLink()},help:()=>f.toggle(),fullScreen:()=>this.fullScreen()}),v=a?nv(e,a):av(e,e.replay,t,l);this.element.append(g,u,c.element,h,v,iv(e.notice),o,f.element),a&&this.element.append(rv(e,a.toggle)),this.noScene&&this.element.append(B("div",{class:"card",role:"alert"},B("p",{text:"This browser cannot draw in three dimensions (WebGL). The rest of the page works."}),B("p",{class:"faint",text:this.noScene}))),this.until(this.layout.open.now(p=>{et(u,p.has("layers")),et(c.element,p.has("vehicles")),et(h,p.has("charts"))})),Q0(d,e.gone.signal),this.wire(),this.restore(s),this.wake()}run;settings;element;layout=new zh;scene;noScene="";beat=0;drawn_ms=-1/0;hidden=!1;place(){let{run:e}=this,t=e.selected.value;return{...e.replay?{t_s:e.replay.time_s}:{},...this.scene?{camera:this.scene.camera()}:{},...t===null?{}:{select:e.path(t)},follow:e.following.value,layers:e.layers.value,colour:e.colour.value,theme:this.settings.theme.value,...e.charts.value?{charts:e.charts.value}:{},panels:[...this.layout.open.value]}}restore(e){let{run:t}=this;if(e.theme&&(this.settings.theme.value=e.theme),e.layers&&(t.layers.value=e.layers),e.colour&&t.paint(e.colour),e.charts&&(t.charts.value=e.charts),e.panels&&(this.layout.open.value=new Set(e.panels.filter(n=>["layers","vehicles","charts"].includes(n)))),e.t_s!==void 0&&t.seek(e.t_s),e.select!==void 0){let n=t.number(e.select);n===void 0?t.say(`This run has no vehicle “${e.select}”.`,!0):t.select(n)}e.camera&&this.scene?.setCamera(e.camera),e.follow!==void 0&&(t.following.value=e.follow&&t.selected.value!==null)}stats(){return this.scene?.stats()??{drawn:0,ms:0}}dispose(){let e=this.place();return cancelAnimationFrame(this.beat),this.run.gone.abort(),this.scene?.dispose(),this.element.remove(),e}wake(){this.beat!==0||this.run.gone.signal.aborted||(this.beat=requestAnimationFrame(e=>{this.beat=0,e-this.drawn_ms>=this.rest()&&(this.drawn_ms=e,this.draw(e)),this.run.player.busy&&this.wake()}))}rest(){let{ms:e}=this.stats();return e<E1?0:Math.min(1.25*e,T1)}draw(e){let{run:t,scene:n}=this,s=t.player.advance(e);s&&((s.jumped||this.hidden)&&n?.jumped(),this.hidden=!1,n?.show(s.a,s.b,s.f),s.packets.length>0&&n?.addPackets(s.packets,this.speed()),t.time.value=s.t_s,t.replay&&(t.links.value=t.linksAt(s.t_s)))}speed(){let{run:e}=this;return e.replay?e.replay.speed.value:e.state.value?.speed||1}wire(){let{run:e,scene:t,settings:n}=this;if(e.onBusy=()=>this.wake(),t){e.layers.now(o=>t.setLayers(o));let r=()=>{let{by:o,name:a}=e.colour.value,l=e.colourSeries(),c=o==="speed"?"m/s":l===null?"":e.series.ofVehicles().get(l)??"";t.setColour(o,o==="value"?Gs(a):o==="battery"?"charge":o,c)};e.colour.now(r),e.series.known.on(()=>e.colour.value.by!=="kind"&&e.colour.value.by!=="speed"&&r()),e.selected.on(o=>{t.select(o),e.following.value&&t.follow(o)}),e.following.on(o=>t.follow(o?e.selected.value:null)),e.details.on(o=>t.setDetails(o)),e.links.on(o=>t.setLinks(o)),e.wind.on(o=>t.setWind(o)),this.until(n.dark.on(o=>t.setDark(o))),addEventListener("resize",()=>t.resize(),{signal:e.gone.signal})}let{replay:s}=e;if(s){s.playing.on(()=>this.wake()),e.time.on(Ui(300,()=>e.selected.value!==null&&e.askDetails()));let r=setInterval(()=>{s.plan(),s.busy&&this.wake()},1e3);e.gone.signal.addEventListener("abort",()=>clearInterval(r))}document.addEventListener("visibilitychange",()=>{document.hidden?this.hidden=!0:this.wake()},{signal:e.gone.signal}),addEventListener("hashchange",()=>this.restore(Ka(location.hash)),{signal:e.gone.signal})}pick(e){this.run.select(e),e!==null&&!this.layout.narrow.matches&&(this.layout.tab.value="vehicles",this.layout.set("vehicles",!0))}look(e){this.scene?.setView(e)}fit(){this.run.following.value=!1,this.scene?.fit()}follow(){let{run:e}=this;e.selected.value===null?e.say("Select a vehicle first, then it can be followed."):e.following.value=!e.following.value}async savePicture(){let{run:e}=this;if(this.scene)try{let t=await this.scene.png(),n=`${e.name.replace(/[^\w.-]+/g,"-")}-${e.time.value.toFixed(2)}s.png`,s=URL.createObjectURL(t);B("a",{href:s,download:n}).click(),setTimeout(()=>URL.revokeObjectURL(s),1e4),e.say(`Saved ${n}.`)}catch(t){e.say(`The picture could not be saved: ${t instanceof Error?t.message:String(t)}.`,!0)}}async copyLink(){history.replaceState(null,"",`#${Vf(this.place())}`);try{await navigator.clipboard.writeText(location.href),this.run.say("The link to this view is in the clipboard.")}catch{this.run.say("The address of this page now is the link to this view.")}}fullScreen(){(document.fullscreenElement?document.exitFullscreen():document.documentElement.requestFullscreen()).catch(()=>this.run.say("This browser does not allow full screen here.",!0))}until(e){this.run.gone.signal.addEventListener("abort",e)}keys(e,t){let{run:n,settings:s,layout:r}=this,o=(l,c,h,u)=>({group:l,keys:c.split(" "),does:h,act:u});return[...n.live?this.liveKeys(o):this.replayKeys(o),...ff.map(([l,c,h])=>o("View",h,c.toLowerCase(),()=>this.look(l))),o("View","a","all vehicles in sight",()=>this.fit()),o("View","f","follow the selected vehicle",()=>this.follow()),o("View","Escape","select nothing",()=>n.select(null)),...Hs.map((l,c)=>o("Show",String(c+1),df[l].toLowerCase(),()=>n.toggleLayer(l))),o("Page","/","find a vehicle",e),o("Page","l","layers and colours",()=>r.toggle("layers")),o("Page","v","vehicles",()=>r.toggleTab("vehicles")),o("Page","m","marks: contacts, events, log",()=>r.toggleTab("marks")),o("Page","c","charts",()=>r.toggle("charts")),o("Page","i","save a picture",()=>{this.savePicture()}),o("Page","y","copy a link to this view",()=>{this.copyLink()}),o("Page","d","theme: auto, light, dark",()=>s.nextTheme()),o("Page","z","large text",()=>s.large.value=!s.large.value),o("Page","Shift+F","full screen",()=>this.fullScreen()),o("Page","? h","these keys",t)]}liveKeys(e){let t=pf(this.run);return[e("Run","Space","pause and resume",t.toggle),e("Run",".","step one instant",t.instant),e("Run",">","step 0.1 s",t.tenth),e("Run","-","slower",()=>t.pace(-1)),e("Run","+ =","faster",()=>t.pace(1)),e("Run","0","as time on the wall",()=>t.setPace(1)),e("Run","9","as fast as possible",()=>t.setPace(null))]}replayKeys(e){let{run:t}=this,n=t.replay,s=mf(t,n);return[e("Time","Space","play and pause",s.toggle),e("Time",". ArrowRight","one tick on",()=>s.step(1)),e("Time",", ArrowLeft","one tick back",()=>s.step(-1)),e("Time","]","next mark",()=>t.seekMark(1)),e("Time","[","mark before",()=>t.seekMark(-1)),e("Time","-","slower",()=>s.faster(-1)),e("Time","+ =","faster",()=>s.faster(1)),e("Time","0","speed 1 ×",()=>s.setSpeed(1)),e("Time","Home","to the beginning",()=>t.seek(n.span.from_s)),e("Time","End","to the end",()=>t.seek(n.span.to_s))]}};var fv=1,xf=document.getElementById("page"),A1=new Ja,Gh=B("div",{class:"card greeting",id:"greeting",role:"status"},B("p",{text:"Connecting to the program …"}));xf.append(Gh);var Ln=null,Uo=null,vf=new Za(zf(location),{message(i){i.type==="hello"?R1(i):i.type==="error"&&!Ln?_f(i.text):Ln?.hear(i)},frame(i){Ln?.live?.take(i,performance.now()),Ln?.replay?.take(i),Uo?.wake()},values(i){Ln?.live&&Ln.series.push(i)},garbled:i=>Ln?Ln.say(i,!0):_f(i)});xf.append(sv(vf.link,()=>Ln,()=>vf.retry()));Object.assign(window,{simbeeotic:{place:()=>Uo?.place(),stats:()=>Uo?.stats(),state:()=>Ln?.state.value,time_s:()=>Ln?.time.value,frame:()=>Ln?.player.frame,vehicle:i=>Ln?.number(i)}});addEventListener("error",i=>Ln?.say(`Something went wrong on this page: ${i.message}`,!0));addEventListener("unhandledrejection",i=>Ln?.say(`Something went wrong on this page: ${i.reason}`,!0));function R1(i){if(i.protocol!==fv){_f(`The program speaks another language (${i.protocol}, this page ${fv}). Load the page again.`);return}let e=Ka(location.hash);Uo&&(e=Uo.dispose()),et(Gh,!1),Ln=new Bh(i,vf),Uo=new Vh(Ln,A1,xf,e),i.truncated&&Ln.say("This recording ends early: the program that wrote it was stopped.",!0)}function _f(i){Gh.replaceChildren(B("p",{text:i})),et(Gh,!0)}
