document.getElementById("page").textContent="Simbeeotic";
