/* What is asked and answered, from the file EXCHANGE. */
    .section .exchange, "a"
    .global exchange
    .global exchange_end
exchange:
    .incbin EXCHANGE
exchange_end:
